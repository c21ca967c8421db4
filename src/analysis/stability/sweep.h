// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "analysis/stability/search.h"

namespace sprag
{
  struct Scene;

  /// The slides of one direction with one set of constants, along x; at a single x only the worst is told.
  struct SweptWay
  {
    Direction direction;
    std::vector<std::string> constants; ///< see CheckedSlide
    CriticalSearch along;
  };

  /// The slides that a verdict looks at: of Stability/Position or the whole stroke, of Stability/Direction or both, with the
  /// constants of the scene and each combination of the ends of Stability/Ranges.
  struct SweptSlides
  {
    std::vector<SweptWay> ways;

    /// Returns the worst slide, of one direction or both. Throws AnalysisError where one of them could not be checked.
    const CheckedSlide &worst(Direction direction = Direction::both) const;

    unsigned int slides() const; ///< checked
  };

  /// Checks them. `in_full`: also finds the x where the kind changes, and checks values inside each range, the other constants
  /// being the scene's own: seven of a reduced lever, else the middle.
  SweptSlides sweep(const Scene &scene, DynamicsMaker &maker, bool in_full = false);

  /// Returns the names of those of Stability/Ranges whose ends give the same slides, to the last digit.
  std::vector<std::string> ranges_without_effect(const Scene &scene, const SweptSlides &swept);

  /// Returns the slides that a sweep checks without those where a growth rate peaks.
  unsigned int least_slides(const Scene &scene, bool in_full = false);

  /// Returns whether values inside the range need meshes of their own.
  bool changes_mesh(const Scene &scene, const ParameterRange &range);

  /// Finds the changes of the verdict along one parameter of the scene, that on the worst of its slides.
  CriticalSearch critical_values(
      const Scene &scene, const ParameterRange &range, double tolerance, DynamicsMaker &maker,
      const std::function<void()> &tried = [] {});
} // namespace sprag
