// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "model/newton.h"
#include "model/port_forces.h"

#include <algorithm>
#include <cmath>

namespace sprag
{
  /// Share of Newton's tolerance up to which a step in time leaves out the last correction: 1e-8 of the overlap, far below what
  /// the step errs by.
  constexpr double left_out_in_time = 0.1;

  /// The equations z = z_free + G f(z) on the selected ports.
  struct PortEquations
  {
    const PortCompliance &compliance;
    const dealii::Vector<double> &free;
    const dealii::Vector<double> &lengths; ///< what a unit of each port moves
    const PortSelection &selected;

    /// Over the longest length.
    static constexpr double round_off = 1e-14;

    double smallest_movement() const
    {
      double scale = 0.;
      for (const unsigned int i : selected)
        scale = std::max(scale, lengths[i]);
      return round_off * scale;
    }

    /// The largest movement of a material point that a change means.
    double movement(const dealii::Vector<double> &change) const
    {
      double largest = 0.;
      for (const unsigned int i : selected)
        largest = std::max(largest, std::abs(lengths[i] * change[i]));
      return largest;
    }

    /// Sets z_free + G f - z.
    void set_mismatch(const PortForces &forces, const dealii::Vector<double> &z, dealii::Vector<double> &mismatch) const
    {
      for (const unsigned int i : selected)
        mismatch[i] = free[i] - z[i];
      add_response(compliance, forces.ports, forces.values, selected, mismatch);
    }
  };

  /// The answer of a contact to displacements of the ports.
  struct PortEvaluation
  {
    const PortForces *forces;
    double overlap; ///< size of the contact's deformation [mm]
  };

  struct PortSolution
  {
    NewtonResult newton;
    const PortForces *forces; ///< at the z that was found
  };

  /// Solves the equations, see solve_by_newton(), from the guess in `z`. `contact_at(z)` returns a
  /// PortEvaluation.
  template <class Contact>
  PortSolution solve_ports(const PortEquations &equations, const Contact &contact_at, dealii::Vector<double> &z,
                           const double left_out = 0.)
  {
    struct Found : PortEvaluation
    {
      double residual;
    };
    dealii::Vector<double> mismatch(equations.free.size());
    const auto movement = [&](const dealii::Vector<double> &change) { return equations.movement(change); };
    const auto evaluate = [&](const dealii::Vector<double> &at)
    {
      const PortEvaluation found = contact_at(at);
      equations.set_mismatch(*found.forces, at, mismatch);
      return Found{ found, movement(mismatch) };
    };
    const auto correction = [&](const Found &found)
    { return port_correction(equations.compliance, found.forces->ports, found.forces->tangent, equations.selected, mismatch); };
    const auto newton = solve_by_newton(z, equations.smallest_movement(), evaluate, correction, movement, left_out);
    return { newton, newton.found.forces };
  }
} // namespace sprag
