// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "analysis/stability/stability.h"
#include "scene/vibration_settings.h"

#include <functional>
#include <string>

namespace sprag
{
  struct Scene;

  /// A slide and what it does, or the worst of several.
  struct CheckedSlide
  {
    SlideKind kind     = SlideKind::jammed;
    double growth_rate = std::numeric_limits<double>::quiet_NaN(); ///< largest Re lambda [1/s]; NaN where it jams
    double frequency   = std::numeric_limits<double>::quiet_NaN(); ///< of that mode [Hz]
    double uniqueness  = std::numeric_limits<double>::quiet_NaN();
    double mu          = std::numeric_limits<double>::quiet_NaN();
    double P           = std::numeric_limits<double>::quiet_NaN(); ///< [N]
    std::string motion;                                            ///< see SlideStability::motion()
    DrivePoint drive;                                              ///< where
    std::vector<std::string> constants; ///< "Section/Name=value", of Stability/Ranges; empty: those of the scene
    std::vector<double> growth_rates;   ///< of the modes by increasing |lambda|; empty of the worst of several
  };

  /// Returns whether a does worse than b: what jams is worse than what vibrates, this than what is stable; then growth decides.
  bool is_worse(const CheckedSlide &a, const CheckedSlide &b);

  /// A value of a parameter at which the kind of a slide changes.
  struct CriticalValue
  {
    double value = 0.;
    SlideKind below; ///< kind just below the value
    SlideKind above;
    CheckedSlide worse; ///< the worse of the slides on both sides
    double mu = 0.;     ///< of the slide below; NaN where there is no equilibrium
  };

  /// Changes of stability found along one parameter of the scene.
  struct CriticalSearch
  {
    ParameterRange range;
    std::optional<SlideKind> first; ///< kind at the smallest value that could be checked; none: none could
    std::vector<CriticalValue> changes;
    std::optional<CheckedSlide> worst; ///< of all values tried
    std::vector<double> not_checked;   ///< values that the scene does not admit, or at which the analysis failed
    std::string reason;                ///< why the last of them was not
    double spacing           = 0.;     ///< of the values tried throughout
    unsigned int more_values = 0;      ///< tried between them, where a growth rate peaks
    bool has_effect          = true;   ///< whether any two of the values tried differ in their growth
  };

  /// Values that a search is expected to try beside the points of its range.
  constexpr unsigned int expected_values_between = 8;

  struct SearchEffort
  {
    double tolerance;          ///< of a change, over the range; 0: changes are not sought
    unsigned int island_steps; ///< golden sections where a growth rate peaks
  };

  /// Finds the changes of kind along a parameter. It is tried at the range's points and at `hints` between them, then where a
  /// growth rate peaks so high that it may change its sign, and the changes are narrowed by bisection, or by regula falsi between
  /// growth rates of both signs. An island narrower than the spacing that no growth rate hints at is missed. `check_at` throws
  /// InputError or AnalysisError for values that cannot be checked; these are passed over. `tried` is called after each value.
  CriticalSearch search_kinds(
      const ParameterRange &range, const SearchEffort &effort, const std::function<CheckedSlide(double)> &check_at,
      const std::vector<double> &hints = {}, const std::function<void()> &tried = [] {});

  /// The slides of one direction with one set of constants, along x; at a single x only the worst is told.
  struct SweptWay
  {
    Direction direction;
    std::vector<std::string> constants; ///< see CheckedSlide
    CriticalSearch along;
  };

  /// The slides that a verdict looks at: of Stability/Position or the whole stroke, of Stability/Direction or both, with the
  /// constants of the scene, each combination of the ends of Stability/Ranges, and values inside each range.
  struct SweptSlides
  {
    std::vector<SweptWay> ways;

    /// Returns the worst slide, of one direction or both. Throws AnalysisError where one of them could not be checked.
    const CheckedSlide &worst(Direction direction = Direction::both) const;

    unsigned int slides() const; ///< checked
  };

  /// Checks them. Inside each range a reduced lever is checked at seven values, any other in the middle, with the other constants
  /// of the worst slide found so far. `in_full`: also finds the x where the kind changes. Else a direction is checked inside the
  /// ranges only if it is stable at their ends: it is unsafe otherwise, be it by flutter or as it jams inside.
  SweptSlides sweep(const Scene &scene, DynamicsMaker &maker, bool in_full = false);

  /// Returns the names of those of Stability/Ranges whose ends give the same slides, to the last digit.
  std::vector<std::string> ranges_without_effect(const Scene &scene, const SweptSlides &swept);

  /// Returns the slides that a sweep checks if all are stable at the ends of the ranges, without those where a growth rate peaks.
  unsigned int least_slides(const Scene &scene);

  /// Returns whether values inside the range need meshes of their own.
  bool changes_mesh(const Scene &scene, const ParameterRange &range);

  /// Finds the changes of the verdict along one parameter of the scene, that on the worst of its slides.
  CriticalSearch critical_values(
      const Scene &scene, const ParameterRange &range, double tolerance, DynamicsMaker &maker,
      const std::function<void()> &tried = [] {});
} // namespace sprag
