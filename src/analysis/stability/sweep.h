// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "analysis/stability/kind_search.h"
#include "scene/vibration_settings.h"

#include <functional>
#include <map>
#include <string>
#include <utility>

namespace sprag
{
  struct Scene;

  /// The slides of one direction along x, with one set of constants. At a single x `along` holds only the worst.
  struct SweptDirection
  {
    Direction direction;
    std::vector<std::string> constants; ///< see CheckedSlide
    CriticalSearch along;
  };

  /// The slides that decide a verdict: at Stability/Position or over the stroke, in Stability/Direction or both, with the
  /// constants of the scene, all combinations of the ends of Stability/Ranges and values inside each range.
  struct SweptSlides
  {
    std::vector<SweptDirection> sweeps; ///< one for each set of constants and direction

    /// Returns the worst slide of one direction or both. Throws AnalysisError if one of them could not be checked.
    const CheckedSlide &worst(Direction direction = Direction::both) const;

    /// Returns the number of slides checked.
    unsigned int count_slides() const;
  };

  /// Equilibria that models share which differ in damping alone: by their other constants, see CheckedSlide, then by x and v.
  using SharedEquilibria = std::map<std::vector<std::string>, std::map<std::pair<double, double>, std::optional<HeldSlide>>>;

  /// Says which of the slides are checked, and how.
  struct SweepPart
  {
    bool in_full = false; ///< also locates the x where the kind changes, and checks unstable directions inside the ranges
    std::optional<std::vector<std::string>> constants = {};      ///< these alone, see CheckedSlide
    std::optional<Direction> direction                = {};      ///< this alone
    SharedEquilibria *shared                          = nullptr; ///< found by sweeps of scenes that differ in damping alone
  };

  /// Checks these slides. Inside each range a reduced lever is checked at seven values, any other in the middle, with the other
  /// constants of the worst slide so far. A direction that is unstable at the ends of the ranges is not checked inside them.
  SweptSlides sweep(const Scene &scene, DynamicsMaker &maker, const SweepPart &part = {});

  /// Returns the names of Stability/Ranges without influence: both ends give identical slides.
  std::vector<std::string> ranges_without_effect(const Scene &scene, const SweptSlides &swept);

  /// Returns the number of slides of a sweep without those near peaks of growth. `inside`: all are stable at the ends of the
  /// ranges, so that those inside are checked as well.
  unsigned int least_slides(const Scene &scene, bool inside = true);

  /// Returns the slides of a verdict in a search or a map: as it may or may not look inside the ranges, the mean of both by
  /// ratio.
  double searched_slides(const Scene &scene);

  /// The work that a search of critical values is expected to be.
  struct SearchWork
  {
    double values = 0.; ///< of the parameter
    double slides = 0.; ///< of all of them
  };

  SearchWork expected_work(const Scene &scene, const ParameterRange &range);

  /// Returns whether values inside the range need meshes of their own.
  bool changes_mesh(const Scene &scene, const ParameterRange &range);

  /// Finds the changes of the verdict along a parameter of the scene; the worst of the slides decides. `tried` gets the
  /// number of slides so far.
  CriticalSearch critical_values(
      const Scene &scene, const ParameterRange &range, double tolerance, DynamicsMaker &maker,
      const std::function<void(double)> &tried = [](double) {});
} // namespace sprag
