#pragma once

#include "model/port_forces.h"

#include <cmath>

namespace sprag
{
  struct PortSolution
  {
    bool converged           = false;
    unsigned int iterations  = 0;
    const PortForces *forces = nullptr; ///< of the last evaluation
  };

  /// Solves z = z_free + G f(z) on the selected ports by Newton's method with a line search, from the guess in `z`. `evaluate(z)`
  /// returns the forces;
  /// `overlap()` is the size of the contact's deformation at the last evaluation [mm], `lengths` what a unit of each port moves.
  /// Converged when the last correction is below 1e-7 of the overlap: as convergence is quadratic, what is left is round-off.
  template <class Evaluate, class Overlap>
  PortSolution solve_ports(const dealii::FullMatrix<double> &compliance, const dealii::Vector<double> &free,
                           const dealii::Vector<double> &lengths, const PortSelection &selected, const Evaluate &evaluate,
                           const Overlap &overlap, dealii::Vector<double> &z)
  {
    constexpr unsigned int maximum_iterations = 40;
    constexpr unsigned int maximum_halvings   = 8;
    constexpr double relative_tolerance       = 1e-7;
    constexpr double round_off                = 1e-14;

    const auto size = [&](const dealii::Vector<double> &movement)
    {
      double largest = 0.;
      for (const unsigned int i : selected)
        largest = std::max(largest, std::abs(lengths[i] * movement[i]));
      return largest;
    };
    double scale = 0.;
    for (const unsigned int i : selected)
      scale = std::max(scale, lengths[i]);

    PortSolution solution;
    dealii::Vector<double> mismatch(free.size());
    const auto unbalance = [&](const dealii::Vector<double> &at)
    {
      solution.forces = &evaluate(at);
      for (const unsigned int i : selected)
        mismatch[i] = free[i] - at[i];
      add_response(compliance, solution.forces->ports, solution.forces->values, selected, mismatch);
      return size(mismatch);
    };

    double norm = unbalance(z);
    dealii::Vector<double> next;
    while (solution.iterations++ < maximum_iterations)
    {
      const auto correction = port_correction(compliance, *solution.forces, selected, mismatch);
      if (size(correction) <= relative_tolerance * overlap() + round_off * scale)
      {
        z += correction;
        solution.forces    = &evaluate(z);
        solution.converged = true;
        return solution;
      }
      double share = 1.;
      double found = norm;
      for (unsigned int i = 0; i <= maximum_halvings; ++i, share *= 0.5)
      {
        next = z;
        next.add(share, correction);
        found = unbalance(next);
        if (found < (1. - 1e-3 * share) * norm)
          break;
      }
      z    = next;
      norm = found;
    }
    return solution;
  }
} // namespace sprag
