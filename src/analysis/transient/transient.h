// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "analytic/energy_ledger.h"
#include "base/progress_keeper.h"
#include "model/step/dynamic_model.h"
#include "results/columns.h"
#include "results/warning.h"
#include "scene/discretisation_settings.h"
#include "scene/drive.h"

#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace sprag
{
  struct Scene;

  /// A vibration about the steady slide at one place of a drive that grows enough to matter before the drive leaves.
  struct GrowingMode
  {
    double x;           ///< [mm]
    double v;           ///< of the drive there [mm/s]
    double growth_rate; ///< [1/s], > 0
    double frequency;   ///< [Hz], > 0
  };

  /// Finds the fastest growing vibration at each of a few places of the drive's first cycle, those left out at which none grows
  /// by more than a factor of 1000 within a stroke. Where the model has no slide there is none. Decides by all vibrations of a
  /// small model; requires one that finds them all (not finite elements).
  std::vector<GrowingMode> growing_modes(DynamicModel &model, const Drive &drive);

  /// Returns the algorithmic damping over critical: the loss of the logarithm of an amplitude in a radian, of `angle` > 0 radians
  /// a step, in the generalised-alpha method. It rises with the angle.
  double algorithmic_damping(double spectral_radius, double angle);

  /// Returns the relative decrease of a frequency by that method, 1 - arg A(angle)/angle, for `angle` >= 0 radians per step.
  double algorithmic_frequency_error(double spectral_radius, double angle);

  /// Returns the longest step that damps each mode by less than a tenth of its growth and turns it by 1 rad at most [s]; infinite
  /// without modes.
  double longest_step(const std::vector<GrowingMode> &modes, double spectral_radius);

  /// Warns of vibrations that a fixed step hides as it is longer than longest_step(). Adaptive steps never are.
  Warnings hidden_vibration_warnings(const std::vector<GrowingMode> &modes, const TimeSettings &time);

  /// Settings of a run in time, with the scales to which tolerances refer.
  struct TransientSettings
  {
    TimeSettings time;
    double force_scale          = 1.;   ///< P to which the tolerance refers [N], > 0
    double contact_stiffness    = 1.;   ///< dP/d(gap) that turns errors of the gap into such of P [N/mm], > 0
    double quasi_static_spacing = 0.25; ///< change of x from one equilibrium to the next, lines between [mm], > 0
    double longest_step         = std::numeric_limits<double>::infinity(); ///< of adaptive ones [s], > 0

    /// Returns the tolerance of a step. Errors of steps go with dt^3 and that of the run with dt^2; for the ringing of models A
    /// and B their sizes are as follows.
    double local_tolerance() const
    {
      return std::pow(0.5 * time.tolerance, 1.5);
    }
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
