// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "analysis/stability/stability.h"
#include "scene/vibration_settings.h"

#include <array>
#include <functional>

namespace sprag
{
  struct Scene;

  /// A value of a parameter at which the kind of a slide changes.
  struct CriticalValue
  {
    double value = 0.;
    double mu    = 0.; ///< of the slide there; NaN where there is no equilibrium
    SlideKind below;   ///< kind just below the value
    SlideKind above;
    std::string motion; ///< of a pair on the unstable side, see SlideStability::motion()
  };

  /// Changes of stability found along one parameter of the scene.
  struct CriticalSearch
  {
    ParameterRange range;
    std::optional<SlideKind> first; ///< kind at the smallest value that could be judged; none: none could
    std::vector<CriticalValue> changes;
    std::vector<double> not_judged; ///< values that the scene does not admit, or at which the analysis failed
    double spacing           = 0.;  ///< of the values tried throughout
    unsigned int more_values = 0;   ///< tried between them, where a growth rate peaks
  };

  /// Finds the changes of kind along one parameter of the scene: it is tried at the range's points, then where the growth rate of
  /// a mode peaks between them so high that it may change its sign, and bisected to `tolerance` of the range. An island narrower
  /// than the spacing that no growth rate at the points hints at is missed. Values that cannot be judged are passed over.
  /// `point_done` is called after each of the range's points.
  CriticalSearch critical_values(
      const Scene &scene, const ParameterRange &range, double tolerance, DynamicsMaker &maker,
      const std::function<void()> &point_done = [] {});
} // namespace sprag
