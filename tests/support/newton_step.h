#pragma once

#include "model/model.h"

namespace sprag
{
  /// Newton's method from `trial` in the model's step, halving a correction until the unbalance falls, to round-off. False if it
  /// ends elsewhere.
  inline bool solve_step(Model &model, State &trial, const FrictionMode first)
  {
    double norm = model.evaluate(trial, first).norm;
    for (unsigned int i = 0; i < 40; ++i)
    {
      const auto correction = model.correction();
      const double movement = model.movement(correction);
      const bool full       = movement <= 1e-10 || (first == FrictionMode::stick && i == 0);
      const auto from       = trial.coordinates;
      double next           = norm;
      for (double share = 1.; share > 0.01; share *= 0.5)
      {
        trial.coordinates = from;
        trial.coordinates.add(share, correction);
        next = model.evaluate(trial, FrictionMode::cone).norm;
        if (full || next < norm)
          break;
      }
      norm = next;
      if (movement <= 1e-12)
        return true;
    }
    return false;
  }

  /// The accepted state after sliding forward to 20 mm at 112 mm/s; `solved`(model, accepted, drive) is the equilibrium of a
  /// step.
  template <class Solved>
  State slid_forward(Model &model, const Solved &solved)
  {
    State accepted = model.initial_state({ 0., 0., 112. });
    for (const double x : { 5., 10., 15., 20. })
    {
      accepted = solved(model, accepted, DrivePoint{ x / 112., x, 112. });
      model.remember(accepted);
    }
    return accepted;
  }
} // namespace sprag
