// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "model/interface/interface_forces.h"
#include "model/interface/interface_layout.h"

namespace sprag
{
  /// Returns the rotations of the hubs among the interface displacements [rad].
  inline PerLever lever_rotations(const InterfaceLayout &layout, const dealii::Vector<double> &displacements)
  {
    PerLever result{};
    for (unsigned int lever = 0; lever < layout.levers; ++lever)
      result[lever] = displacements[layout.rotation(lever)];
    return result;
  }

  // The contact of each lever numbers the dofs as of a single lever: its own, and the support's where it is sprung.

  /// Returns a lever's part of the displacements, or nothing of nothing.
  dealii::Vector<double> extract_lever(const InterfaceLayout &layout, unsigned int lever,
                                       const dealii::Vector<double> &all_displacements);

  /// Returns the number among all of a dof of a lever's contact.
  unsigned int joined_dof(const InterfaceLayout &layout, unsigned int lever, unsigned int dof);

  /// Writes forces of the contacts of the levers, in their order, as forces on the whole interface, with a tangent where all have
  /// theirs.
  void join_forces(const InterfaceLayout &layout, const std::vector<const InterfaceForces *> &per_lever, InterfaceForces &result);
} // namespace sprag
