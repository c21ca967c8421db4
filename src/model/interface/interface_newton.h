// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "base/ranges.h"
#include "model/interface/interface_forces.h"
#include "model/interface/newton.h"

#include <algorithm>
#include <cmath>

namespace sprag
{
  /// Share of Newton's tolerance up to which a step in time leaves out the last correction: 1e-8 of the penetration, far below
  /// what the step errs by.
  constexpr double left_out_in_time = 0.1;

  /// The equations z = z_free + G f(z) on the selected dofs.
  struct InterfaceEquations
  {
    const InterfaceCompliance &compliance;
    const dealii::Vector<double> &free;
    const dealii::Vector<double> &lengths; ///< movement by a unit of each dof
    const DofSelection &selected;

    /// Movements below this, over the longest length, are round-off.
    static constexpr double round_off = 1e-14;

    double smallest_movement() const
    {
      return round_off * largest(selected, [&](const unsigned int i) { return lengths[i]; });
    }

    /// The largest movement of a material point that a change means.
    double movement(const dealii::Vector<double> &change) const
    {
      return largest(selected, [&](const unsigned int i) { return lengths[i] * change[i]; });
    }

    /// Sets z_free + G f - z.
    void set_mismatch(const InterfaceForces &forces, const dealii::Vector<double> &z, dealii::Vector<double> &mismatch) const
    {
      for (const unsigned int i : selected)
        mismatch[i] = free[i] - z[i];
      add_response(compliance, forces.dofs, forces.values, selected, mismatch);
    }
  };

  /// The answer of a contact to interface displacements.
  struct InterfaceEvaluation
  {
    const InterfaceForces *forces;
    double penetration; ///< size of the contact's deformation [mm]
  };

  /// Result of solve_interface().
  struct InterfaceSolution
  {
    NewtonResult newton;
    const InterfaceForces *forces; ///< at the z that was found
  };

  /// Solves the equations, see solve_by_newton(), from the guess in `z`. `contact_at(z)` returns a InterfaceEvaluation.
  template <class Contact>
  InterfaceSolution solve_interface(const InterfaceEquations &equations, const Contact &contact_at, dealii::Vector<double> &z,
                                    const double left_out = 0.)
  {
    struct Found : InterfaceEvaluation
    {
      double residual;
    };
    dealii::Vector<double> mismatch(equations.free.size());
    const auto movement = [&](const dealii::Vector<double> &change) { return equations.movement(change); };
    const auto evaluate = [&](const dealii::Vector<double> &at)
    {
      const InterfaceEvaluation found = contact_at(at);
      equations.set_mismatch(*found.forces, at, mismatch);
      return Found{ found, movement(mismatch) };
    };
    const auto correction = [&](const Found &found) {
      return interface_correction(equations.compliance, found.forces->dofs, found.forces->tangent, equations.selected, mismatch);
    };
    const auto newton = solve_by_newton(z, equations.smallest_movement(), evaluate, correction, movement, left_out);
    return { newton, newton.found.forces };
  }
} // namespace sprag
