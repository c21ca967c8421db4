// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "model/interface/interface_forces.h"
#include "model/interface/interface_layout.h"
#include "model/step/contact_point.h"

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

  // Contact histories of both levers of a pair in one list: entries of the second lever are numbered after all of the first's,
  // which has `points` contact points.

  /// Returns the entries of one lever, with the numbers that its points have alone.
  inline std::vector<ContactHistory> lever_history(const unsigned int lever, const unsigned int points,
                                                   const std::vector<ContactHistory> &pair_history)
  {
    std::vector<ContactHistory> result;
    for (auto entry : pair_history)
      if (entry.point / points == lever)
      {
        entry.point -= lever * points;
        result.push_back(entry);
      }
    return result;
  }

  /// Joins the entries of both levers.
  inline std::vector<ContactHistory> joined_history(const unsigned int points, std::vector<ContactHistory> first,
                                                    const std::vector<ContactHistory> &second)
  {
    for (auto entry : second)
    {
      entry.point += points;
      first.push_back(entry);
    }
    return first;
  }
} // namespace sprag
