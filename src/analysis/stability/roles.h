// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "analysis/stability/stability.h"

namespace sprag
{
  struct Scene;

  /// A slide with one of its ingredients left out.
  struct Role
  {
    std::string name;                                                         ///< "without_flexure" ...
    std::string meaning;                                                      ///< what was done
    std::optional<SlideKind> kind = {};                                       ///< none where the analysis failed
    double growth_rate            = std::numeric_limits<double>::quiet_NaN(); ///< [1/s]; NaN where there is none to tell
    double frequency              = std::numeric_limits<double>::quiet_NaN(); ///< [Hz]
    std::string motion            = {}; ///< of a pair's most unstable mode, see SlideStability::motion()
  };

  /// Checks the slide again without flexure, inertia, mu'(v), damping and a sprung support, each left out alone.
  std::vector<Role> roles(const Scene &scene, const SlideStability &present, DynamicsMaker &maker);
} // namespace sprag
