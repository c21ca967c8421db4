// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "base/choices.h"
#include "scene/analysis_settings.h"

#include <optional>
#include <string>
#include <vector>

namespace sprag
{
  /// A curve is C_Q over mu at the scene's geometry (Fig. 10), or over th0 for a list of e/R at the scene's mu (Fig. 11).
  SPRAG_ENUMERATION(SlopeSweep, coefficient, inclination)

  struct SlopeSettings
  {
    SlopeSweep sweep                  = SlopeSweep::coefficient;
    unsigned int n_points             = 121;
    double maximum_coefficient        = 1.2;
    double maximum_inclination        = 1.0471975511965976; ///< [rad]
    std::vector<double> offset_ratios = { 0., 0.2, 0.4, 0.6, 0.8 };
  };

  /// A parameter by its --set name and the values that it takes, as texts.
  struct VariedParameter
  {
    std::string name;
    std::vector<std::string> values;
  };

  /// Values of several parameters combine to a grid, each with each of the others, or as a list: the first of all, the second of
  /// all ...
  SPRAG_ENUMERATION(Combination, grid, list)

  /// Runs of one analysis of the scene at other values of its parameters.
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

  /// Added mass is Lever/Hub inertia or Lever/Tip mass.
  SPRAG_ENUMERATION(AddedMass, hub, tip)

  /// Targets that a calibration gives the meshed parts.
  struct CalibrationSettings
  {
    std::optional<double> stiffness;         ///< k [N mm/rad] by the leaf spring's thickness; none: the leaf as it is
    std::optional<double> moment_of_inertia; ///< J [t mm^2] by added mass; none: as it is
    AddedMass mass = AddedMass::hub;
  };
} // namespace sprag
