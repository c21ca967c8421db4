// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "laws/friction.h"

#include <cmath>

namespace sprag
{
  /// The law as one step sees it: where mu depends on the drive's speed [mm/s] it is a constant of the step.
  inline FrictionLaw friction_of_step(const FrictionLaw &friction, const double drive_speed)
  {
    FrictionLaw law = friction;
    if (law.speed == FrictionSpeed::drive)
    {
      law.law    = CoulombFriction{ friction_coefficient(friction, std::abs(drive_speed)).coefficient };
      law.factor = 1.;
    }
    return law;
  }
} // namespace sprag
