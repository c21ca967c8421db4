// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "analysis/stability/stability.h"
#include "analysis/transient/envelope.h"
#include "analysis/transient/held_run.h"
#include "scene/vibration_settings.h"

namespace sprag
{
  /// Called with every row of a run, right after its step.
  using RowSink = std::function<void(const Row &row)>;

  /// Measured growth or decay of a small perturbation of a held slide, beside its eigenvalue.
  ///
  /// The eigenvalue is that of the contact in time as long as it slides on without stick. In three dimensions delays of friction
  /// are left out, see friction_lag().
  struct Growth
  {
    std::complex<double> eigenvalue; ///< predicted [1/s]
    ExponentialFit envelope{};       ///< measured, of P - P of the slide [N]
    double frequency = 0.;           ///< measured [Hz]; NaN where the mode does not oscillate
    std::vector<Sample> sizes;       ///< the envelope fitted, over the mean penetration
    bool slid    = true;             ///< neither stick nor loss of contact in the window
    bool reached = false;            ///< the amplitude aimed at, within Sprag slip/Longest growth

    /// Returns the frequency that the eigenvalue predicts [Hz].
    double predicted_frequency() const
    {
      return eigenvalue.imag() / (2. * M_PI);
    }

    // Measured over predicted, less 1.
    double growth_difference() const
    {
      return envelope.rate / eigenvalue.real() - 1.;
    }

    double frequency_difference() const
    {
      return frequency / predicted_frequency() - 1.;
    }
  };

  /// Returns the mode that is watched: the worst one, or of a stable slide the oscillating one that decays slowest.
  const Eigenmode &watched_mode(const SlideStability &stability);

  /// Returns the duration of a step: the mode's period over Sprag slip/Steps per period [s]. Without oscillation 2 pi / |lambda|
  /// stands for the period.
  double choose_step(const Eigenmode &mode, const SpragSlipSettings &settings);

  /// Perturbs a slide along its watched mode and follows that from the initial amplitude to the final one, a stable slide from
  /// the final to the initial. The run goes on from there. Requires a slide that is not jammed; throws AnalysisError as
  /// HeldRun::step().
  Growth measure_growth(DynamicModel &model, const SlideStability &stability, const SpragSlipSettings &settings, HeldRun &run,
                        const RowSink &sink);
} // namespace sprag
