// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "base/choices.h"
#include "scene/plane_state.h"

#include <string>
#include <vector>

namespace sprag
{
  /// Names what a run finds; a study runs any of those before the map at other values of the parameters.
  SPRAG_ENUMERATION(AnalysisType, quasi_static, slope, transient, contact_law, modal, stability, sprag_slip, calibration,
                    isolation, map, identification, design, study)

  /// The lever is massless and ideal (closed form), a rigid one that turns, of Hermite beam elements, of vibration modes and
  /// static face shapes of the finite elements (condensed), or of finite elements.
  SPRAG_ENUMERATION(ModelType, closed_form, rigid, beam, condensed, finite_element)

  inline bool is_meshed(const ModelType model)
  {
    return model == ModelType::condensed || model == ModelType::finite_element;
  }

  /// Returns whether the model has a few coordinates and no mesh, so that it is checked in no time.
  inline bool is_reduced(const ModelType model)
  {
    return model == ModelType::rigid || model == ModelType::beam;
  }

  /// Factorises once where the material is linear (automatic), or in every Newton iteration (general).
  SPRAG_ENUMERATION(Solution, automatic, general)

  /// Says whether warnings end a run with an error.
  SPRAG_ENUMERATION(WarningTreatment, report, error)

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

  /// Asks for an accuracy or a cost, from which the settings follow that a file leaves open.
  struct AccuracySettings
  {
    double target          = 0.;         ///< relative error wanted [-]; 0: nothing follows from it
    std::string quantity   = "auto";     ///< names of quantities of /accuracy, separated by commas
    double budget          = 0.;         ///< CPU time that a run may take [s]; 0: any
    bool is_model_open     = false;      ///< Analysis/Model = auto
    bool is_dimension_open = false;      ///< Analysis/Dimension = auto
    std::vector<std::string> quantities; ///< those meant

    bool is_asked_for() const
    {
      return target > 0. || budget > 0.;
    }

    /// Returns whether the program must choose something of the scene before it runs it.
    bool leaves_open() const
    {
      return is_dimension_open || is_asked_for();
    }
  };
} // namespace sprag
