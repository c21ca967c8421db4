// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "analysis/stability/stability.h"
#include "analysis/transient/held_run.h"
#include "analytic/error_estimate.h"
#include "base/choices.h"
#include "base/unknown.h"
#include "scene/vibration_settings.h"

#include <cmath>
#include <optional>
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
    double scatter;   ///< root mean square of the residuals of the logarithms
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
  /// The eigenvalue is that of the contact in time as long as it slides on without stick. In three dimensions what the spring
  /// of stick delays is left out, see friction_lag().
  struct Growth
  {
    std::complex<double> eigenvalue; ///< predicted [1/s]
    ExponentialFit envelope{};       ///< measured, of P - P of the slide [N]: of a pair's lever that the mode moves more
    double frequency = 0.;           ///< measured [Hz]; NaN where the mode does not oscillate
    std::vector<Sample> sizes;       ///< the envelope fitted, over the mean penetration
    bool slid    = true;             ///< neither stick nor loss of contact in the window
    bool reached = false;            ///< the final amplitude, within Sprag slip/Longest growth

    /// Returns the frequency that the eigenvalue predicts [Hz].
    double predicted_frequency() const
    {
      return std::abs(eigenvalue.imag()) / (2. * M_PI);
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

  /// Period of the vibration that a slide comes to and the duration of its steps [s].
  struct CycleSteps
  {
    double period;
    double dt;
  };

  /// Returns those of the watched mode. A divergence has no period, and runs away in microseconds or seconds: its slowest
  /// vibration stands for it, in a quarter of the steps, as the slip that runs away is over sooner.
  CycleSteps choose_cycle_steps(const SlideStability &stability, const SpragSlipSettings &settings);

  /// Perturbs a slide along its watched mode and follows that from the initial amplitude to the final one, a stable slide from
  /// the final to the initial. The run continues from there. Requires a slide that is not jammed; throws AnalysisError as
  /// HeldRun::step().
  Growth measure_growth(DynamicModel &model, const SlideStability &stability, const SpragSlipSettings &settings, HeldRun &run,
                        const RowSink &sink);

  /// Means and amplitudes of a vibration about a held slide over a number of its periods.
  struct CycleWindow
  {
    double begin                 = 0.; ///< [s]
    double end                   = 0.; ///< [s]
    double amplitude_P           = 0.; ///< half of largest less smallest, of a pair's lever where that is larger [N]
    double slide_P               = 0.; ///< of that lever in the slide [N]
    double amplitude_indentation = 0.; ///< the same [mm]
    double open_share            = 0.; ///< of the time, without contact
    double stick_share           = 0.; ///< of the time, with a point in contact that does not slide on with the cylinder
    double frequency             = 0.; ///< strongest line of P's spectrum [Hz]; NaN without one
    double period                = 0.; ///< after which P is the same again [s]; NaN if it never is
    double period_change         = 0.; ///< of P over a period, see Recurrence

    /// Returns the number of vibrations in a period, NaN without one.
    double vibrations() const
    {
      return period > 0. ? std::round(period * frequency) : unknown;
    }
  };

  /// Classifies the long-term motion about a held slide: it returns to the slide, repeats itself in every window (cycle), neither
  /// decays nor repeats itself (irregular), or is too small to classify (undecided).
  SPRAG_ENUMERATION(Settling, slide, cycle, irregular, undecided)

  /// The final vibration or slide of a motion about a held slide.
  struct Settled
  {
    Settling kind = Settling::undecided;
    CycleWindow window;    ///< the last; of an irregular vibration over its last half
    double agreement = 0.; ///< relative difference of amplitude_P in the last two windows

    bool vibrates() const
    {
      return kind == Settling::cycle || kind == Settling::irregular;
    }
  };

  /// Periods and limits of time by which a long-term outcome is decided.
  struct SettlingTimes
  {
    double period;   ///< of the slide's vibration [s]; a window has 20
    double shortest; ///< before anything is checked [s]
    double longest;  ///< after which the outcome is decided by the data so far [s]
  };

  /// Amplitude of P over its mean below which a shrinking vibration counts as decaying to rest.
  constexpr double small_vibration = 1e-2;

  /// Continues about a held slide until P repeats itself, no worse than before, and three windows agree, in amplitudes and
  /// frequency within 1 % and in the share of open time within 0.01, or the vibration is small and shrinks. Throws as
  /// HeldRun::step().
  Settled settle(HeldRun &run, const HeldSlide &slide, const SettlingTimes &times, const RowSink &sink);

  /// Estimates the errors of cycle_amplitude_P, cycle_frequency and cycle_vibrations by finite steps: the cycle is followed on in
  /// half the steps from where the run ended, and twice the change counts, of the number of vibrations once. Contact that opens
  /// or sticks within a step errs in first order. None of a motion that comes to rest; the reason in words of one that does not
  /// repeat itself. `period`: see SettlingTimes. Throws as HeldRun::step().
  std::vector<ErrorEstimate> estimate_cycle_errors(DynamicModel &model, const HeldRun &run, const HeldSlide &slide,
                                                   const Settled &settled, double period);

  /// The slide and the vibrations found at one x.
  struct ContinuationPoint
  {
    SlideStability slide; ///< checked there
    double x = 0.;        ///< [mm]
    Settled away;         ///< the vibration carried along, or what a large kick of the slide leads to
    Settled back;         ///< the slide, perturbed a little, or a vibration carried along

    /// Returns whether there is a slide to vibrate about.
    bool holds() const
    {
      return slide.kind != SlideKind::jammed;
    }

    /// Returns whether a stable slide and a vibration both exist there.
    bool coexist() const
    {
      return slide.kind == SlideKind::stable && (away.vibrates() || back.vibrates());
    }
  };

  /// Range in which a stable slide and a vibration coexist [mm], `from` < `to`.
  struct Coexistence
  {
    double from;
    double to;
  };

  /// Follows vibrations and slides from one x to the next, away from the start and back. The centre moves at the drive's speed at
  /// most, the slip continues at that of the slides.
  class Continuation
  {
  public:
    /// Perturbations of a slide over its penetration.
    static constexpr double small_kick = 1e-3;
    static constexpr double large_kick = 3.;

    /// Bisections of the interval in which a vibration carried along decays.
    static constexpr unsigned int bisections = 3;

    /// Starts at `drive`; `modes` is that of check_slide(). The run must begin at the slide or vibration there.
    Continuation(DynamicModel &model, HeldRun &run, const DrivePoint &drive, const SettlingTimes &times,
                 const CheckedModes &modes, const SpragSlipSettings &settings);

    /// Goes to `turn` [mm] in the scene's number of intervals, finds where the vibration decays, and returns. `done` is
    /// called after each x. Finished results are available after an exception too. Throws as HeldRun::step() and
    /// check_slide().
    void go(const SlideStability &slide, const Settled &start, double turn, const std::function<void()> &done);

    /// Returns the points visited so far, from the start to the turn.
    const std::vector<ContinuationPoint> &points() const
    {
      return visited;
    }

    /// Finds the longest interval in which a stable slide and a vibration were both found. It ends where the slide loses its
    /// stability, to within 1e-3 mm, or at the last x at which the vibration was found; none if there is no such x.
    std::optional<Coexistence> coexistence();

  private:
    /// The last x, of those visited, at which the vibration carried away existed, and its state there.
    struct Alive
    {
      std::size_t point;
      RunState state;
    };

    ContinuationPoint checked(double x);
    Settled settled(const ContinuationPoint &point);
    Settled kicked(const ContinuationPoint &point, double amplitude);
    Settled carried(const ContinuationPoint &from, const ContinuationPoint &to);
    void go_away(double turn, const std::function<void()> &done);
    void find_death(const std::function<void()> &done);
    void go_back(const std::function<void()> &done);
    double stability_limit(double stable, double unstable);

    DynamicModel &model;
    HeldRun &run;
    const DrivePoint drive;
    const CheckedModes modes;
    const SpragSlipSettings &settings;
    const SettlingTimes times;
    std::vector<ContinuationPoint> visited;
    std::optional<Alive> last_alive;
  };
} // namespace sprag
