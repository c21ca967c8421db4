#pragma once

#include "scene/scene.h"

#include <string>
#include <vector>

namespace sprag
{
  /// A rule between parameters that a scene breaks.
  struct Violation
  {
    std::string parameter;           ///< "Section/Name" of the one to be changed
    std::vector<std::string> others; ///< that the rule also depends on
    std::string rule;                ///< "must be ..."
  };

  /// Everything that no single parameter shows: a cylinder that fits the lever and does not reach the pivot, the contact on the
  /// lever, no locking of the closed form, settings that exclude each other. Each parameter alone is assumed to be in range.
  std::vector<Violation> violations(const Scene &scene);
} // namespace sprag
