// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "analysis/stability/stability.h"
#include "base/unknown.h"
#include "scene/drive.h"
#include "scene/vibration_settings.h"

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace sprag
{
  /// The stability of one steady slide, or of the worst of several.
  struct CheckedSlide
  {
    SlideKind kind     = SlideKind::jammed;
    double growth_rate = unknown; ///< largest Re lambda [1/s]; NaN where it jams
    double error       = 0.;      ///< of that, see SlideStability [1/s]
    double frequency   = unknown; ///< of that mode [Hz]
    double uniqueness  = unknown;
    double mu          = unknown;
    double P           = unknown;        ///< [N]
    std::string motion;                  ///< see SlideStability::motion()
    DrivePoint drive;                    ///< position and speed
    std::vector<std::string> constants;  ///< "Section/Name=value", of Stability/Ranges; empty: those of the scene
    double beyond_frequency   = unknown; ///< of SlideStability::beyond [Hz]; NaN: none grows
    double beyond_growth_rate = unknown; ///< [1/s]
    std::vector<double> growth_rates;    ///< of the modes by increasing |lambda| [1/s]; empty for the worst of several
  };

  /// Returns whether a is worse than b: jammed before unstable before stable, then by the larger growth rate. One whose
  /// growth is smaller than its error comes between those that surely grow and those that surely die out.
  bool is_worse(const CheckedSlide &a, const CheckedSlide &b);

  /// Returns whether two slides have bitwise equal growth rates and forces. Slides that jam (NaN) never have.
  bool are_equal(const CheckedSlide &a, const CheckedSlide &b);

  /// A value of a parameter at which the kind of a slide changes.
  struct CriticalValue
  {
    double value = 0.; ///< on the better side, within the tolerance of the search
    SlideKind below;   ///< kind just below the change
    SlideKind above;
    CheckedSlide worse;     ///< the worse of the slides on both sides
    double mu    = 0.;      ///< of the slide below; NaN where there is no equilibrium
    double error = unknown; ///< by which the error of the growth rate moves a limit of stability; NaN: not estimated
    // At the limit of stability within Stability/Ranges also its place
    double own    = unknown; ///< with the constants of the scene
    double likely = unknown; ///< with probable_share of the constants, of which all in the ranges are equally likely
  };

  /// Share of the constants in Stability/Ranges for which CriticalValue::likely holds.
  constexpr double probable_share = 0.95;

  /// The slides at a place that were checked with a value of a parameter.
  struct PlaceGrowth
  {
    double value;
    double x;           ///< [mm]
    double direction;   ///< 1 forward, -1 backward
    double growth_rate; ///< largest of all constants [1/s]; NaN where one jams
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
    std::vector<PlaceGrowth> places               = {};   ///< what that is the largest of, of critical_values()
  };

  /// Limits of search_kinds().
  struct SearchEffort
  {
    double tolerance;          ///< of a change, over the length of the range; 0: changes are not located
    unsigned int island_steps; ///< golden-section steps at each peak of a growth rate
    bool first_change = false; ///< the range's points are tried up to the first that differs from the one before
  };

  /// Checks a value of a parameter.
  struct ValueChecks
  {
    std::function<CheckedSlide(double)> at; ///< returns the worst of its slides
    /// Returns the worst of those alone with the constants and direction of another slide; empty: at() serves.
    std::function<CheckedSlide(double, const CheckedSlide &)> alike = {};
    std::function<void()> tried                                     = [] {}; ///< called after each value
  };

  /// Returns a point of a range, from 0 on.
  double range_point(const ParameterRange &range, unsigned int i);

  /// Finds the changes of kind along a parameter: at the range's points and `hints`, then near peaks of growth rates that may
  /// cross 0. Changes are located by bisection or regula falsi. A range of another kind narrower than the spacing can be missed.
  /// Values for which a check throws InputError or AnalysisError are skipped.
  CriticalSearch search_kinds(const ParameterRange &range, const SearchEffort &effort, const ValueChecks &checks,
                              const std::vector<double> &hints = {});
} // namespace sprag
