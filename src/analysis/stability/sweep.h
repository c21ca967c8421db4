// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "analysis/stability/stability.h"
#include "base/unknown.h"
#include "scene/vibration_settings.h"

#include <functional>
#include <string>

namespace sprag
{
  struct Scene;

  /// The stability of one steady slide, or of the worst of several.
  struct CheckedSlide
  {
    SlideKind kind     = SlideKind::jammed;
    double growth_rate = unknown; ///< largest Re lambda [1/s]; NaN where it jams
    double frequency   = unknown; ///< of that mode [Hz]
    double uniqueness  = unknown;
    double mu          = unknown;
    double P           = unknown;       ///< [N]
    std::string motion;                 ///< see SlideStability::motion()
    DrivePoint drive;                   ///< position and speed
    std::vector<std::string> constants; ///< "Section/Name=value", of Stability/Ranges; empty: those of the scene
    std::vector<double> growth_rates;   ///< of the modes by increasing |lambda| [1/s]; empty for the worst of several
  };

  /// Returns whether a is worse than b: jammed before unstable before stable, then by the larger growth rate.
  bool is_worse(const CheckedSlide &a, const CheckedSlide &b);

  /// A value of a parameter at which the kind of a slide changes.
  struct CriticalValue
  {
    double value = 0.; ///< on the better side, within the tolerance of the search
    SlideKind below;   ///< kind just below the change
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
    std::optional<CheckedSlide> worst;                  ///< of all values tried
    std::vector<double> not_checked;                    ///< values that the scene does not admit, or at which the analysis failed
    std::string reason;                                 ///< why the last of them was not
    double spacing                                = 0.; ///< of the values tried throughout
    unsigned int more_values                      = 0;  ///< tried between them, where a growth rate peaks
    bool has_effect                               = true; ///< whether any two of the values tried differ in their growth
    std::vector<std::pair<double, double>> growth = {};   ///< values that were checked, with their largest growth rate [1/s]
  };

  /// Returns the values that a search is expected to try beside the points of its range.
  unsigned int expected_values_between(const Scene &scene);

  /// Limits of search_kinds().
  struct SearchEffort
  {
    double tolerance;          ///< of a change, over the length of the range; 0: changes are not located
    unsigned int island_steps; ///< golden-section steps at each peak of a growth rate
  };

  /// Finds the changes of kind along a parameter: at the range's points and `hints`, then near peaks of growth rates that may
  /// cross 0. Changes are located by bisection or regula falsi. A range of another kind narrower than the spacing can be missed.
  /// Values for which `check_at` throws InputError or AnalysisError are skipped. `tried` is called after each value.
  CriticalSearch search_kinds(
      const ParameterRange &range, const SearchEffort &effort, const std::function<CheckedSlide(double)> &check_at,
      const std::vector<double> &hints = {}, const std::function<void()> &tried = [] {});

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

  /// Checks these slides. Inside each range a reduced lever is checked at seven values, any other in the middle, with the other
  /// constants of the worst slide so far. `in_full`: also locates the x where the kind changes. Else a direction that is unstable
  /// at the ends of the ranges is not checked inside them.
  SweptSlides sweep(const Scene &scene, DynamicsMaker &maker, bool in_full = false);

  /// Returns the names of Stability/Ranges without influence: both ends give identical slides.
  std::vector<std::string> ranges_without_effect(const Scene &scene, const SweptSlides &swept);

  /// Returns the number of slides of a sweep without those near peaks of growth. `inside`: all are stable at the ends of the
  /// ranges, so that those inside are checked as well.
  unsigned int least_slides(const Scene &scene, bool inside = true);

  /// Returns whether values inside the range need meshes of their own.
  bool changes_mesh(const Scene &scene, const ParameterRange &range);

  /// Finds the changes of the verdict along a parameter of the scene; the worst of the slides decides.
  CriticalSearch critical_values(
      const Scene &scene, const ParameterRange &range, double tolerance, DynamicsMaker &maker,
      const std::function<void()> &tried = [] {});
} // namespace sprag
