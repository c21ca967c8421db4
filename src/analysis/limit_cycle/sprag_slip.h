// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "analysis/stability/stability.h"
#include "analysis/transient/held_run.h"
#include "scene/vibration_settings.h"

#include <vector>

namespace sprag
{
  /// A value at an instant [s].
  struct Sample
  {
    double time;
    double value;
  };

  /// Finds the extrema of a signal between its changes of sign, as sizes > 0: one a half period, at the vertex of the parabola
  /// through the largest sample and its neighbours. What stands before the first and behind the last change of sign is left out.
  std::vector<Sample> compute_envelope(const std::vector<Sample> &signal);

  /// Finds the times of the changes of sign, between samples by a straight line [s].
  std::vector<double> crossings(const std::vector<Sample> &signal);

  /// A exp(g t) fitted to sizes by the least squares of their logarithms.
  struct ExponentialFit
  {
    double rate;      ///< g [1/s]; NaN with fewer than 3 sizes
    double amplitude; ///< A, at time 0
    double scatter;   ///< root mean square of what the logarithms are off
  };

  /// Fits sizes, all > 0.
  ExponentialFit fit_exponential(const std::vector<Sample> &sizes);

  /// Returns half the number of changes of sign per time, by least squares of their times over their numbers [Hz]; NaN with fewer
  /// than 3.
  double fit_frequency(const std::vector<double> &crossings);

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
