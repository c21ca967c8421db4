#pragma once

#include "scene/check.h"

namespace sprag
{
  /// Penalties given that are stiffer than the friction face of a built-in mesh takes, see params/README.md.
  std::vector<Violation> penalty_violations(const Scene &scene);
} // namespace sprag
