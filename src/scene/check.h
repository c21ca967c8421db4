#pragma once

#include "scene/rules.h"
#include "scene/scene.h"

namespace sprag
{
  /// Everything that no single parameter shows: a cylinder that fits the lever and does not reach the pivot, the contact on the
  /// lever, no locking of the closed form, settings that exclude each other. Each parameter alone is assumed to be in range.
  std::vector<Violation> violations(const Scene &scene);
} // namespace sprag
