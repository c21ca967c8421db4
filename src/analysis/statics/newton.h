#pragma once

#include "model/model.h"
#include "model/newton.h"

namespace sprag
{
  /// Solves the equilibrium of `trial` in the model's step, see solve_by_newton(), from the coordinates in `trial`. With
  /// `stick_first` the first correction assumes stick everywhere, which finds the direction of slip after a reversal.
  NewtonResult solve_equilibrium(Model &model, State &trial, bool stick_first);

  /// Returns whether a state that no step led to is an equilibrium, up to round-off.
  bool is_balanced(Model &model, const State &state);
} // namespace sprag
