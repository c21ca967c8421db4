// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "base/progress_keeper.h"
#include "model/interface/newton.h"
#include "model/step/model.h"
#include "scene/discretisation_settings.h"
#include "scene/drive.h"

#include <algorithm>
#include <functional>
#include <optional>

namespace sprag
{
  /// Share of Newton's tolerance up to which an equilibrium leaves out the last correction: 1e-9 of the penetration.
  constexpr double left_out_in_statics = 0.01;

  /// Solves the equilibrium of a step by solve_by_newton(), from its trial state. `stick_first`: the first correction assumes
  /// stick everywhere, which finds the direction of slip after a reversal.
  NewtonSolution<Evaluation> solve_equilibrium(Model &model, Step &step, bool stick_first, double left_out = left_out_in_statics);

  /// Settings of a run without inertia.
  struct QuasiStaticSettings
  {
    double step         = 1.;   ///< largest change of x in a step [mm]
    double minimum_step = 1e-6; ///< smaller steps end the run [mm]
    ContactSettings contact;
  };

  /// Returns how short steps through stick are over the usual ones, for the largest change of x in a step [mm]. Their error goes
  /// with their length, that of lines between rows with the square of theirs.
  inline double stick_step_share(const double step)
  {
    return std::min(1., step * step);
  }

  /// Returns the state at the beginning, x = 0: just touching, or in equilibrium without friction if the cylinder already opens
  /// the lever (of a pair with an offset).
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

  /// Returns the stiffness dF/dx with all points in contact stuck [N/mm]: layer, tangential penalty and body in series; of a
  /// pair that of both levers. 0 if the contact is open.
  double stick_stiffness(Model &model, const State &accepted);

  /// Moves the model along the drive through equilibria without inertia. A step without equilibrium is cut back; later ones grow
  /// again. A step ends at each reversal, and those behind it resolve the passage through stick. `sink` receives every accepted
  /// step. Throws AnalysisError if no step of the minimum size succeeds. Returns stick_stiffness() at the first reversal, 0
  /// without one. A run that `keeper` has progress of is resumed with identical results.
  double run_quasi_static(Model &model, const Drive &drive, const QuasiStaticSettings &settings, const StepSink &sink,
                          ProgressKeeper *keeper = nullptr);
} // namespace sprag
