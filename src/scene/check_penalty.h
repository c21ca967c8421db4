#pragma once

#include "scene/check.h"

namespace sprag
{
  /// Penalties given that are stiffer than the friction face of a built-in mesh takes, see params/README.md.
  void check_penalty(const Scene &scene, Rules &rules);
} // namespace sprag
