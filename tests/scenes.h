// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "scene/scene.h"

namespace sprag
{
  // The two scenes of Table 1 of the paper, with cork on aluminium at the true sliding speed and one stroke 0 .. 65 .. 0 mm
  // at 112 mm/s.

  inline Scene model_a()
  {
    Scene scene;
    scene.geometry         = { 56., 45.6, 185.5, 0. };
    scene.spring.stiffness = 7.40e4;
    scene.drive            = Drive(DriveProfile::triangle, 0., 65., 112., 1.);
    scene.friction         = { CorkOnAluminium{}, FrictionSpeed::sliding };
    return scene;
  }

  inline Scene model_b()
  {
    Scene scene            = model_a();
    scene.geometry         = { 21.1, 0., 193.9, 0. };
    scene.spring.stiffness = 6.41e4;
    return scene;
  }

  inline Scene with_coulomb(Scene scene, const double coefficient)
  {
    scene.friction.law = CoulombFriction{ coefficient };
    return scene;
  }

  /// The paper's choice, mu by the speed of the drive.
  inline Scene with_friction_by_drive_speed(Scene scene)
  {
    scene.friction.speed = FrictionSpeed::drive;
    return scene;
  }

  /// A rotational spring of moment k (turn + cubic turn^3) up to a turn of 0.2 either way.
  inline RotationalSpring with_cubic_hardening(const double stiffness, const double cubic)
  {
    std::vector<MomentLaw::Sample> samples;
    for (int i = -4; i <= 4; ++i)
    {
      const double turn = 0.05 * i;
      samples.push_back({ turn, stiffness * turn * (1. + cubic * turn * turn), stiffness * (1. + 3. * cubic * turn * turn) });
    }
    RotationalSpring spring;
    spring.stiffness     = stiffness;
    spring.behaviour.law = MomentLaw(stiffness, samples);
    return spring;
  }
} // namespace sprag
