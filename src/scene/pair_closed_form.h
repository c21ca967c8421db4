// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "scene/closed_form.h"

#include <array>

namespace sprag
{
  struct Device;

  // The closed form of a full mirrored pair: both levers massless and rigid, each with eqs. 4-9 of Yamaguchi & Yoshida in its own
  // (for the second: mirrored) axes, lever_geometry() and lever_friction(). Both turn from rest_inclination(). With a joint
  // that is held each has a spring of its own, M_i = M(phi_i). With a free one nothing holds them but each other: the springs'
  // energy 2 W((phi_1 + phi_2)/2) gives M_1 = M_2 = M((phi_1 + phi_2)/2). A lever that would have to be pulled to the cylinder
  // does not touch it. With a held joint it stays at its spring's rest. With a free one neither touches: both stay off by the
  // same angle.

  /// Returns the inclinations of both levers at x, with or without contact [rad].
  std::array<double, 2> pair_inclinations(const Device &device, double x);

  /// Holds the state of one lever of a pair by the closed form.
  struct PairedLever
  {
    ClosedFormState state;       ///< without contact of its theta alone, the rest 0
    bool touches         = true; ///< whether it touches the cylinder, even without force
    double spring_energy = 0.;   ///< its share [N mm]
  };

  /// Returns both levers at x while the cylinder moves at v; of a zero the sign is the direction. Forces are infinite or negative
  /// as in closed_form().
  std::array<PairedLever, 2> pair_closed_form(const Device &device, double x, double v);

  /// Integrates the work on each lever from one instant of the drive to another, as accurate as that of a single one.
  std::array<Work, 2> pair_work_between(const Device &device, double begin, double end);
} // namespace sprag
