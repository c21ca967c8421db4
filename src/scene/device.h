// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "laws/friction_law.h"
#include "scene/analysis_settings.h"
#include "scene/apparatus.h"
#include "scene/discretisation_settings.h"
#include "scene/drive.h"
#include "scene/lever.h"

#include <string>

namespace sprag
{
  // A scene is plain data: the device and its loading, independent of the model.
  // Units: mm, N, s, tonne, rad (so MPa and mJ). All forces and stiffnesses are per lever over its whole width.

  /// The device, its drive and its discretisation: the part of a scene from which models are made.
  struct Device
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
    CondensedSettings condensed;
    ContactSettings contact;
    MeshSettings mesh;
    std::string name;   ///< file name without folder and ending
    std::string folder; ///< of the file, to which paths are relative
  };
} // namespace sprag
