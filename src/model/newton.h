#pragma once

#include <deal.II/lac/vector.h>

#include <algorithm>

namespace sprag
{
  /// Of the overlap, see solve_by_newton().
  constexpr double relative_tolerance = 1e-7;

  struct NewtonResult
  {
    bool converged          = false;
    unsigned int iterations = 0; ///< linear solves
  };

  /// Newton's method with a line search that halves the correction until the unbalance falls, from the guess in `x`:
  ///   evaluate(x)    returns the size of the unbalance at x, to which the others refer,
  ///   correction()   the change of x that removes it in the linearised equations,
  ///   movement(dx)   the largest movement of a material point that a change means [mm],
  ///   overlap()      the largest p / penalty over the contact points [mm].
  /// Converged when a full correction moves no point by more than 1e-7 of the overlap and `round_off` [mm]: as convergence is
  /// quadratic, what is left is round-off. With a share left_out > 0 also where the unbalance that a full correction leaves would
  /// move no point by more than this share of that, if a unit of it moves what one did at most before; this saves the last
  /// correction. x is evaluated last.
  template <class Evaluate, class Correction, class Movement, class Overlap>
  NewtonResult solve_by_newton(dealii::Vector<double> &x, const double round_off, const Evaluate &evaluate,
                               const Correction &correction, const Movement &movement, const Overlap &overlap,
                               const double left_out = 0.)
  {
    constexpr unsigned int maximum_iterations = 40;
    constexpr unsigned int maximum_halvings   = 8;

    double unbalance = evaluate(x);
    double by_unit   = 0.; // of unbalance, the largest movement
    for (unsigned int iteration = 1; iteration <= maximum_iterations; ++iteration)
    {
      const auto change     = correction();
      const double moved    = movement(change);
      const auto negligible = [&] { return relative_tolerance * overlap() + round_off; };
      if (moved <= negligible())
      {
        x += change;
        evaluate(x);
        return { true, iteration };
      }
      const dealii::Vector<double> from = x;
      double share                      = 1.;
      double found                      = unbalance;
      for (unsigned int i = 0; i <= maximum_halvings; ++i, share *= 0.5)
      {
        x = from;
        x.add(share, change);
        found = evaluate(x);
        if (found < (1. - 1e-3 * share) * unbalance)
          break;
      }
      by_unit   = std::max(by_unit, moved / unbalance);
      unbalance = found;
      if (share == 1. && by_unit * unbalance < left_out * negligible())
        return { true, iteration };
    }
    return { false, maximum_iterations };
  }
} // namespace sprag
