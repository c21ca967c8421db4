// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "laws/friction_law.h"
#include "scene/analysis_settings.h"
#include "scene/apparatus.h"
#include "scene/contact_settings.h"
#include "scene/design.h"
#include "scene/discretisation_settings.h"
#include "scene/drive.h"
#include "scene/identification.h"
#include "scene/isolation.h"
#include "scene/lever.h"
#include "scene/study_settings.h"
#include "scene/vibration_settings.h"

#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

namespace sprag
{
  // A scene is plain data: what there is and what is done to it, at no particular fidelity.
  // Units: mm, N, s, tonne, rad (so MPa and mJ). All forces and stiffnesses are per lever over its whole width.

  struct Scene
  {
    AnalysisSettings analysis;
    Geometry geometry;
    Drive drive;
    FrictionLaw friction;
    Lever lever;
    FrictionLayer layer;
    LeverFrameShape frame;
    FrictionPlate plate;
    Cylinder cylinder;
    RotationalSpring spring;
    MirroredPair pair;
    Support support;
    TimeSettings time;
    CondensedSettings condensed;
    ContactSettings contact;
    MeshSettings mesh;
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
    std::string name;   ///< file name without folder and ending
    std::string folder; ///< of the file, to which paths are relative

    /// Every parameter as it was read, by "Section/Name", numbers without unit, files with absolute paths; null for a scene that
    /// was not read.
    std::shared_ptr<const std::map<std::string, std::string>> parameters;

    /// Values of parameters that were given with a unit, as they were written.
    std::map<std::string, std::string> written;

    /// Unused columns of tables, by the parameter that names the table.
    std::map<std::string, std::vector<std::string>> unused_columns;

    std::set<std::string> given; ///< "Section/Name" of the parameters that were given rather than left at their defaults

    /// Parameters that the program has chosen so that an accuracy is met, with what stood in their place.
    std::map<std::string, std::string> chosen;
  };
} // namespace sprag
