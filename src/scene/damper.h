// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include <functional>
#include <limits>
#include <string>

namespace sprag
{
  struct Scene;

  // Dampers of an isolation system are symmetric about z = 0. y = |z| is the distance from there; `away` is +1 while it grows and
  // -1 while it shrinks. The resistance is the force against the sign of z.

  /// Holds the force of a damper against the motion away from z = 0, and its dissipation.
  struct Resistance
  {
    double force;      ///< [N]
    double dissipated; ///< power [N mm/s]
  };

  /// Describes a damper by functions of displacement and speed.
  struct Damper
  {
    /// Returns the resistance at y >= 0 and a speed |z'| >= 0 [mm/s]. It continues smoothly a little beyond these bounds, where
    /// trial steps may end.
    std::function<Resistance(double y, double speed, int away)> resistance;

    /// Returns the energy stored [N mm].
    std::function<double(double y)> energy;

    double reach = std::numeric_limits<double>::infinity(); ///< largest y [mm]
    std::string end;                                        ///< what limits y, for messages

    /// Returns a number that is positive while the table can return at this speed, and 0 where the damper locks. Empty: the
    /// damper never locks.
    std::function<double(double y, double speed)> locking_margin;
  };

  /// Makes the damper of the scene's isolation system, of the whole table. Levers are those of the closed form.
  Damper make_damper(const Scene &scene);
} // namespace sprag
