// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "scene/design.h"
#include "scene/device.h"
#include "scene/identification.h"
#include "scene/isolation.h"
#include "scene/study_settings.h"
#include "scene/vibration_settings.h"

#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

namespace sprag
{
  /// A device and the analysis that is made of it, as a file describes them.
  struct Scene : Device
  {
    TimeSettings time;
    OutputSettings output;
    SlopeSettings slope;
    StabilitySettings stability;
    MapSettings map;
    StudySettings study;
    SpragSlipSettings sprag_slip;
    CalibrationSettings calibration;
    IsolationSettings isolation;
    DesignSettings design;
    IdentificationSettings identification;
    AccuracySettings accuracy;

    /// Every parameter as it was read, by "Section/Name", numbers without unit, files with absolute paths; null for a scene that
    /// was not read.
    std::shared_ptr<const std::map<std::string, std::string>> parameters;

    /// Values of parameters that were given with a unit, and relative names of files, as they were written.
    std::map<std::string, std::string> written;

    /// Unused columns of tables, by the parameter that names the table.
    std::map<std::string, std::vector<std::string>> unused_columns;

    std::set<std::string> specified; ///< "Section/Name" of the parameters that were given rather than left at their defaults
    std::set<std::string> by_option; ///< those of them that --set or a variation gave

    /// Parameters that the program has chosen so that an accuracy is met, with what stood in their place.
    std::map<std::string, std::string> chosen;
  };
} // namespace sprag
