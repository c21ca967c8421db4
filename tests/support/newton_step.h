// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "model/step/model.h"

#include <optional>

namespace sprag
{
  /// Newton's method in a step, halving a correction until the residual falls, to round-off. Nothing if it ends elsewhere.
  inline std::optional<Evaluation> solve_step(Model &model, Step &step, const FrictionMode first)
  {
    auto found = model.evaluate(step, first);
    for (unsigned int i = 0; i < 40; ++i)
    {
      const auto correction = model.correction(found);
      const double movement = model.movement(correction);
      const double residual = found.residual;
      const bool full       = movement <= 1e-10 || (first == FrictionMode::stick && i == 0);
      const auto from       = step.trial.coordinates;
      for (double share = 1.; share > 0.01; share *= 0.5)
      {
        step.trial.coordinates = from;
        step.trial.coordinates.add(share, correction);
        found = model.evaluate(step, FrictionMode::cone);
        if (full || found.residual < residual)
          break;
      }
      if (movement <= 1e-12)
        return found;
    }
    return {};
  }

  /// A state in equilibrium, its contact history that of where its step began.
  struct Solved
  {
    State state;
    Evaluation found;
  };

  /// The accepted state after sliding forward to 20 mm at 112 mm/s; `solved`(model, accepted, drive) is the equilibrium of a
  /// step.
  template <class Solved>
  State slid_forward(Model &model, const Solved &solved)
  {
    State accepted = model.initial_state({ 0., 0., 112. });
    for (const double x : { 5., 10., 15., 20. })
    {
      auto [state, found] = solved(model, accepted, DrivePoint{ x / 112., x, 112. });
      model.store_history(found, state);
      accepted = std::move(state);
    }
    return accepted;
  }
} // namespace sprag
