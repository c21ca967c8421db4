#pragma once

#include "laws/moment_law.h"
#include "model/port_forces.h"

namespace sprag
{
  /// Adds what a rotational spring gives beyond its linear stiffness, a moment -law.excess(turn) on the port of the rotation, and
  /// its tangent. `rotation` must be among the ports of the forces.
  void add_spring_excess(const MomentLaw &law, unsigned int rotation, double turn, PortForces &forces);
} // namespace sprag
