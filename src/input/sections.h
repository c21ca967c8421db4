// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "base/choices.h"
#include "base/parameters.h"
#include "scene/scene.h"

#include <optional>
#include <string>
#include <vector>

namespace sprag
{
  /// The drive as a parameter file gives it.
  struct DriveSettings
  {
    DriveProfile profile = DriveProfile::triangle;
    double start         = 0.;
    double stroke        = 65.;
    double speed         = 112.;
    double cycles        = 1.;
    double reversal      = 5e-3;
    std::string table;
    double smoothing = 0.;
  };

  /// Contents of a parameter file: a scene whose drive and friction law are still to be made.
  struct SceneSettings
  {
    Scene scene;
    DriveSettings drive;
    FrictionSettings friction;
    double maximum_inclination = 60.;                                  ///< [deg]
    std::optional<double> time_tolerance;                              ///< none: by whether a time step is given
    std::optional<double> face_size;                                   ///< none: by the analysis
    std::optional<double> faces_in_contact;                            ///< none: by the analysis
    std::optional<Enforcement> enforcement;                            ///< none: by the analysis
    std::optional<ModelType> model        = ModelType::finite_element; ///< none: by the requested accuracy
    std::optional<unsigned int> dimension = 2;                         ///< none: by a trial run
  };

  /// Returns the word for a type of analysis, "quasi-static".
  std::string to_word(AnalysisType type);

  /// Lists every parameter of a scene file. Defaults are the present values in `settings`, where Parameter::store writes to;
  /// `settings` must outlive the result.
  std::vector<Parameter> scene_parameters(SceneSettings &settings);
} // namespace sprag
