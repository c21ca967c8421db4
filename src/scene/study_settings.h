// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "base/choices.h"
#include "scene/analysis_settings.h"

#include <optional>
#include <string>
#include <vector>

namespace sprag
{
  /// Selects the abscissa of a slope curve: C_Q over mu at the scene's geometry (Fig. 10), or over th0 at the scene's mu for
  /// several e/R (Fig. 11).
  SPRAG_ENUMERATION(SlopeSweep, coefficient, inclination)

  /// Selects the curves of the representative slope C_Q that an analysis `slope` computes.
  struct SlopeSettings
  {
    SlopeSweep sweep                  = SlopeSweep::coefficient;
    unsigned int n_points             = 121;                        ///< of each curve
    double maximum_coefficient        = 1.2;                        ///< largest mu of a curve over mu
    double maximum_inclination        = 1.0471975511965976;         ///< largest th0 of a curve over th0 [rad]
    std::vector<double> offset_ratios = { 0., 0.2, 0.4, 0.6, 0.8 }; ///< e/R, a curve each
  };

  /// Names a parameter as in --set, and its values as texts.
  struct VariedParameter
  {
    std::string name;
    std::vector<std::string> values;
  };

  /// Says how the values of several parameters combine: to a grid of all combinations, or to a list of the first values, the
  /// second values, ...
  SPRAG_ENUMERATION(Combination, grid, list)

  /// Holds the section Study: one analysis, repeated with other values of parameters.
  struct StudySettings
  {
    AnalysisType type   = AnalysisType::quasi_static; ///< of each run
    std::string vary    = "Friction/Factor = 0.5 ... 1.5 : 5";
    Combination combine = Combination::grid;
    std::string reference; ///< settings of the run that the others are compared with; empty: none

    // parse_variation() fills these from the texts.
    std::vector<VariedParameter> varied;
    std::vector<VariedParameter> reference_values; ///< one value each
  };

  /// Selects the mass that a calibration adjusts: Lever/Hub inertia or Lever/Tip mass.
  SPRAG_ENUMERATION(AddedMass, hub, tip)

  /// Holds the section Calibration: target values for the meshed parts.
  struct CalibrationSettings
  {
    std::optional<double> stiffness;         ///< k [N mm/rad] by the leaf spring's thickness; none: the leaf as it is
    std::optional<double> moment_of_inertia; ///< J [t mm^2] by added mass; none: as it is
    AddedMass mass = AddedMass::hub;
  };
} // namespace sprag
