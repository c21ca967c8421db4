// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include <functional>
#include <limits>
#include <string>

namespace sprag
{
  struct Scene;

  // Dampers of an isolation system act alike on both sides of z = 0. y = |z| is the way from there; `away` is +1 while it grows
  // and -1 while it shrinks. The force against the sign of z is the resistance.

  /// Holds the force of a damper against the motion away from z = 0, and its dissipation.
  struct Resistance
  {
    double force;      ///< [N]
    double dissipated; ///< power [N mm/s]
  };

  /// Describes a damper by functions of displacement and speed.
  struct Damper
  {
    /// Returns the resistance at y >= 0 and a speed |z'| >= 0 [mm/s]. A little beyond these bounds, where trial steps end, it
    /// goes on smoothly.
    std::function<Resistance(double y, double speed, int away)> resistance;

    /// Returns the energy stored [N mm].
    std::function<double(double y)> energy;

    double reach = std::numeric_limits<double>::infinity(); ///< largest y [mm]
    std::string end;                                        ///< what is there

    /// Positive where the damper lets the table come back at this speed; where it falls to 0 the damper locks. Empty: it never
    /// does.
    std::function<double(double y, double speed)> locking_margin;
  };

  /// Makes the damper of the scene's isolation system, of the whole table. Levers are those of the closed form.
  Damper make_damper(const Scene &scene);
} // namespace sprag
