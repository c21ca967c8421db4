// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "model/port_forces.h"
#include "model/port_layout.h"

namespace sprag
{
  /// Rotations of the hubs among the displacements of the ports [rad].
  inline PerLever lever_rotations(const PortLayout &layout, const dealii::Vector<double> &ports)
  {
    PerLever result{};
    for (unsigned int lever = 0; lever < layout.levers; ++lever)
      result[lever] = ports[layout.rotation(lever)];
    return result;
  }

  // The contact of each lever numbers the ports as of a single lever: its own, and the support's where it is sprung.

  /// A lever's part of displacements of all ports, or nothing of nothing.
  dealii::Vector<double> extract_lever_ports(const PortLayout &layout, unsigned int lever,
                                             const dealii::Vector<double> &all_ports);

  /// Port of all of a port of a lever's contact.
  unsigned int joined_port(const PortLayout &layout, unsigned int lever, unsigned int port);

  /// Writes forces of the contacts of the levers, in their order, as forces on all ports, with a tangent where all have theirs.
  void join_forces(const PortLayout &layout, const std::vector<const PortForces *> &per_lever, PortForces &result);
} // namespace sprag
