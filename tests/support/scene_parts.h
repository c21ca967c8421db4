// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "scene/scene.h"

namespace sprag
{
  inline Scene with_drive(Scene scene, const Drive &drive)
  {
    scene.drive = drive;
    return scene;
  }

  /// A full pair of levers.
  inline Scene paired(Scene scene, const SpringJoint joint, const double offset = 0., const double friction_ratio = 1.)
  {
    scene.pair.type            = PairType::full;
    scene.pair.joint           = joint;
    scene.pair.cylinder_offset = offset;
    scene.pair.friction_ratio  = friction_ratio;
    return scene;
  }

  /// On an elastic cylinder of this Young's modulus [MPa] and element length [mm].
  inline Scene on_solid_cylinder(Scene scene, const double young_modulus, const double face_size = Cylinder().face_size)
  {
    scene.cylinder.type          = CylinderType::solid;
    scene.cylinder.young_modulus = young_modulus;
    scene.cylinder.face_size     = face_size;
    return scene;
  }

  /// With the pivot frame on a spring [N/mm].
  inline Scene on_sprung_support(Scene scene, const double stiffness = Support().stiffness)
  {
    scene.support.type      = SupportType::sprung;
    scene.support.stiffness = stiffness;
    return scene;
  }
} // namespace sprag
