// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "analysis/transient/growing_modes.h"
#include "analytic/energy_ledger.h"
#include "base/progress_keeper.h"
#include "model/step/dynamic_model.h"
#include "results/columns.h"
#include "scene/discretisation_settings.h"
#include "scene/drive.h"

#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace sprag
{
  struct Scene;

  struct TransientSettings
  {
    TimeSettings time;
    double force_scale          = 1.;   ///< P to which the tolerance refers [N], > 0
    double contact_stiffness    = 1.;   ///< dP/d(gap) that turns errors of the gap into such of P [N/mm], > 0
    double quasi_static_spacing = 0.25; ///< change of x from one equilibrium to the next, lines between [mm], > 0
    double longest_step         = std::numeric_limits<double>::infinity(); ///< of adaptive ones [s], > 0
  };

  /// Called with every accepted motion, the first included, right after the model made it.
  using MotionSink = std::function<void(const Motion &motion, const Row &row)>;

  /// Integrates the model along the drive by the generalised-alpha method. Every kink of the drive ends a step. With a tolerance
  /// the step adapts: it is halved and tried again where the local error of P, over force_scale, exceeds the tolerance, and
  /// doubled after steps with far smaller ones, up to 16 times Time/Step or the longest step; else it is Time/Step, or less by
  /// what makes a whole number of steps up to the next kink. A step without a solution is halved too. Throws AnalysisError, after
  /// the last accepted step was handed on, where halving does not help. Where the keeper has progress of such a run, this one
  /// goes on from there, to the last bit as if it had not been interrupted.
  TransientReport run_transient(DynamicModel &model, const Drive &drive, const TransientSettings &settings,
                                const MotionSink &sink, ProgressKeeper *keeper = nullptr);

  /// Returns the rows of a scene's run in time by its reduced lever, by a beam where it is meshed: a quick look at how it rings
  /// and how many steps it takes. Throws AnalysisError where the run fails.
  std::vector<Row> beam_run(Scene scene);

  /// Returns the settings of a scene's run in time, whose steps follow the vibrations that grow.
  TransientSettings transient_settings(const Scene &scene, const std::vector<GrowingMode> &growing = {});
} // namespace sprag
