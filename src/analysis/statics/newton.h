#pragma once

#include "model/model.h"

namespace sprag
{
  struct NewtonResult
  {
    bool converged;
    unsigned int iterations; ///< linear solves
  };

  /// Solves the equilibrium of `trial` for a step from `accepted`, starting at the coordinates in `trial`: Newton's method with a
  /// line search that halves the correction until the unbalance falls. With `stick_first` the first iterate assumes stick
  /// everywhere, which finds the direction of slip after a reversal. Converged when the last full correction moves no point by
  /// more than 1e-7 of the overlap of the contact: as convergence is quadratic, what is left is round-off.
  NewtonResult solve_equilibrium(Model &model, State &trial, const State &accepted, bool stick_first);

  /// Evaluates the model and returns whether a state that no step led to is an equilibrium, up to round-off.
  bool is_balanced(Model &model, const State &state);
} // namespace sprag
