// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "base/progress_keeper.h"
#include "model/interface/newton.h"
#include "model/step/model.h"
#include "scene/discretisation_settings.h"
#include "scene/drive.h"

#include <functional>
#include <optional>

namespace sprag
{
  /// Solves the equilibrium of a step, see solve_by_newton(), from the coordinates of its trial state. With `stick_first` the
  /// first correction assumes stick everywhere, which finds the direction of slip after a reversal.
  NewtonSolution<Evaluation> solve_equilibrium(Model &model, Step &step, bool stick_first);

  struct QuasiStaticSettings
  {
    double step         = 1.;   ///< largest change of x in a step [mm]
    double minimum_step = 1e-6; ///< [mm]
    ContactSettings contact;
  };

  /// Returns the state in which a model begins at x = 0: just touching or, where the cylinder opens it there already, off the
  /// middle of a pair, put on it without friction.
  State settled(Model &model, const DrivePoint &start, const QuasiStaticSettings &settings);

  /// A state in equilibrium, with the history of its contact.
  struct Equilibrium
  {
    State state;
    Evaluation found;
  };

  /// Returns the equilibrium at the end of one step from an accepted state, or none where none was found.
  std::optional<Equilibrium> solve_step(Model &model, const State &accepted, const DrivePoint &end,
                                        const QuasiStaticSettings &settings);

  /// Returns the row of a state without inertia, its works 0.
  Row observed(const Model &model, const State &state, const Evaluation &found);

  /// Called with every accepted state, the first included.
  using StepSink = std::function<void(const State &state, const Row &row, const Evaluation &found)>;

  /// Finds the stiffness dF/dx of the lever in stick, with all points under pressure stuck: of layer, tangential penalty and body
  /// in series [N/mm]; of a full pair that of both levers. 0 where the contact is open.
  double stick_stiffness(Model &model, const State &accepted);

  /// Moves the model along the drive through equilibria, inertia left out. Steps are cut back where the equilibrium is not found
  /// and grow again; every reversal is hit exactly, and after it the steps resolve the passage through stick. Contact history is
  /// committed with accepted steps alone. Throws AnalysisError, after the last accepted step was handed on, where no step of the
  /// least size succeeds. Returns stick_stiffness() at the first reversal, 0 if there is none. Where the keeper has progress of
  /// such a run, this one goes on from there, to the last bit as if it had not been interrupted.
  double run_quasi_static(Model &model, const Drive &drive, const QuasiStaticSettings &settings, const StepSink &sink,
                          ProgressKeeper *keeper = nullptr);
} // namespace sprag
