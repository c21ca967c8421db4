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

  struct PortSolution
  {
    NewtonResult newton;
    const PortForces *forces; ///< of the last evaluation
  };

  /// Solves z = z_free + G f(z) on the selected ports, see solve_by_newton(), from the guess in `z`. `forces_at(z)` returns the
  /// forces, `overlap()` is the size of the contact's deformation at the last evaluation [mm], `lengths` what a unit of each port
  /// moves.
  template <class Forces, class Overlap>
  PortSolution solve_ports(const PortCompliance &compliance, const dealii::Vector<double> &free,
                           const dealii::Vector<double> &lengths, const PortSelection &selected, const Forces &forces_at,
                           const Overlap &overlap, dealii::Vector<double> &z, const double left_out = 0.)
  {
    constexpr double round_off = 1e-14; // over the longest length

    double scale = 0.;
    for (const unsigned int i : selected)
      scale = std::max(scale, lengths[i]);
    const PortForces *forces = nullptr;
    dealii::Vector<double> mismatch(free.size());
    const auto movement = [&](const dealii::Vector<double> &change)
    {
      double largest = 0.;
      for (const unsigned int i : selected)
        largest = std::max(largest, std::abs(lengths[i] * change[i]));
      return largest;
    };
    const auto evaluate = [&](const dealii::Vector<double> &at)
    {
      forces = &forces_at(at);
      for (const unsigned int i : selected)
        mismatch[i] = free[i] - at[i];
      add_response(compliance, forces->ports, forces->values, selected, mismatch);
      return movement(mismatch);
    };
    const auto correction = [&] { return port_correction(compliance, forces->ports, forces->tangent, selected, mismatch); };
    const auto newton     = solve_by_newton(z, round_off * scale, evaluate, correction, movement, overlap, left_out);
    return { newton, forces };
  }
} // namespace sprag
