// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "base/choices.h"
#include "scene/plane_state.h"

#include <string>
#include <vector>

namespace sprag
{
  /// Selects the analysis of a run. A study repeats any of those before the map with other values of parameters.
  SPRAG_ENUMERATION(AnalysisType, quasi_static, slope, transient, contact_law, modal, stability, sprag_slip, calibration,
                    isolation, map, identification, design, study)

  /// Selects the model of the lever: massless with ideal contact (closed form), a rigid body, Hermite beam elements, vibration
  /// modes and constraint modes of the finite elements (condensed), or finite elements.
  SPRAG_ENUMERATION(ModelType, closed_form, rigid, beam, condensed, finite_element)

  inline bool is_meshed(const ModelType model)
  {
    return model == ModelType::condensed || model == ModelType::finite_element;
  }

  /// Returns whether the model has few coordinates and no mesh, so that it is cheap.
  inline bool is_reduced(const ModelType model)
  {
    return model == ModelType::rigid || model == ModelType::beam;
  }

  /// Factorises once where the material is linear (automatic), or in every Newton iteration (general).
  SPRAG_ENUMERATION(Solution, automatic, general)

  /// Says whether warnings end a run with an error.
  SPRAG_ENUMERATION(WarningTreatment, report, error)

  /// Selects the analysis, the model of the lever and the limits of a run (section Analysis).
  struct AnalysisSettings
  {
    AnalysisType type         = AnalysisType::quasi_static;
    ModelType model           = ModelType::finite_element;
    unsigned int dimension    = 2;
    PlaneState plane          = PlaneState::stress; ///< of the lever
    Solution solution         = Solution::automatic;
    double step               = 1.;   ///< largest change of x in a step [mm], > 0
    double minimum_step       = 1e-6; ///< smallest change of x tried before the analysis gives up [mm], > 0
    double maximum_deviation  = 0.;   ///< largest admissible deviation from the closed form [-]; 0: any
    double maximum_residual   = 1e-3; ///< largest admissible energy residual over the largest work done [-]; 0: any
    WarningTreatment warnings = WarningTreatment::report;
  };

  /// Holds the section Accuracy: a target or a budget, from which the program chooses the settings that a file leaves open.
  struct AccuracySettings
  {
    double target          = 0.;         ///< relative error [-]; 0: chooses nothing
    std::string quantity   = "auto";     ///< names of quantities of /accuracy, separated by commas
    double budget          = 0.;         ///< CPU time that a run may take [s]; 0: any
    bool is_model_open     = false;      ///< Analysis/Model = auto
    bool is_dimension_open = false;      ///< Analysis/Dimension = auto
    std::vector<std::string> quantities; ///< that `quantity` stands for

    /// Returns whether the program chooses the settings that the scene leaves open.
    bool chooses_settings() const
    {
      return target > 0. || budget > 0.;
    }

    /// Returns whether the program must choose something of the scene before it runs it.
    bool leaves_open() const
    {
      return is_dimension_open || chooses_settings();
    }
  };
} // namespace sprag
