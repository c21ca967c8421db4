// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include <deal.II/lac/vector.h>

#include <algorithm>

namespace sprag
{
  /// Tolerance over the penetration, see solve_by_newton().
  constexpr double relative_tolerance = 1e-7;

  /// Outcome of Newton's method.
  struct NewtonResult
  {
    bool converged          = false;
    unsigned int iterations = 0;  ///< linear solves
    double remaining        = 0.; ///< movement that the residual may leave, over the tolerance; 0 behind a negligible correction
  };

  /// The result and the evaluation at the x that Newton's method ended with.
  template <class Evaluation>
  struct NewtonSolution : NewtonResult
  {
    Evaluation found;
  };

  /// Newton's method with a line search that halves the correction until the residual falls, from the guess in `x`:
  ///   evaluate(x)       returns `residual`, its size, and `penetration`, the largest p / penalty over the contact points [mm],
  ///   correction(found) the change of x that removes the residual of an evaluation in the linearised equations,
  ///   movement(dx)      the largest movement of a material point that a change means [mm].
  /// Converged when a full correction moves no point by more than 1e-7 of the penetration and `round_off` [mm]: as convergence is
  /// quadratic, what is left is round-off. With a share left_out > 0 also where the residual that a full correction leaves would
  /// move no point by more than this share of that, if a unit of it moves what one did at most before; this saves the last
  /// correction.
  template <class Evaluate, class Correction, class Movement>
  auto solve_by_newton(dealii::Vector<double> &x, const double round_off, const Evaluate &evaluate, const Correction &correction,
                       const Movement &movement, const double left_out = 0.)
  {
    constexpr unsigned int maximum_iterations = 40;
    constexpr unsigned int maximum_halvings   = 8;

    NewtonSolution<decltype(evaluate(x))> result{ {}, evaluate(x) };
    auto &found    = result.found;
    double by_unit = 0.; // of residual, the largest movement
    while (result.iterations < maximum_iterations)
    {
      ++result.iterations;
      const auto change     = correction(found);
      const double moved    = movement(change);
      const double residual = found.residual;
      const auto negligible = [&] { return relative_tolerance * found.penetration + round_off; };
      if (moved <= negligible())
      {
        x += change;
        found            = evaluate(x);
        result.converged = true;
        result.remaining = 0.;
        break;
      }
      const dealii::Vector<double> from = x;
      double share                      = 1.;
      for (unsigned int i = 0; i <= maximum_halvings; ++i, share *= 0.5)
      {
        x = from;
        x.add(share, change);
        found = evaluate(x);
        if (found.residual < (1. - 1e-3 * share) * residual)
          break;
      }
      by_unit          = std::max(by_unit, moved / residual);
      result.remaining = by_unit * found.residual / negligible();
      result.converged = share == 1. && result.remaining < left_out;
      if (result.converged)
        break;
    }
    return result;
  }
} // namespace sprag
