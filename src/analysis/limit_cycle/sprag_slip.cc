// SPDX-License-Identifier: GPL-3.0-only
#include "analysis/limit_cycle/sprag_slip.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sprag
{
  namespace
  {
    constexpr double settled_after = 2.; ///< periods left out of the fit: what the mode's first steps excite beside it

    bool oscillates(const Eigenmode &mode)
    {
      return mode.mode.eigenvalue.imag() > smallest_growth * std::abs(mode.mode.eigenvalue);
    }

    double mode_period(const Eigenmode &mode)
    {
      const auto lambda = mode.mode.eigenvalue;
      return 2. * M_PI / (oscillates(mode) ? lambda.imag() : std::abs(lambda));
    }

    /// Says when the signal has grown or decayed by a factor, from its sizes half a period long.
    struct AmplitudeWatch
    {
      const double half_period;
      const double aim; ///< the factor
      double end   = 0.;
      double size  = 0.;
      double first = 0.;

      bool reached(const Sample &sample)
      {
        size = std::max(size, std::abs(sample.value));
        if (sample.time < end)
          return false;
        if (end == 0.)
          end = sample.time;
        end += half_period;
        if (first == 0.)
          first = size;
        const double ratio = size / first;
        size               = 0.;
        return aim > 1. ? ratio >= aim : ratio <= aim;
      }
    };

    std::vector<Sample> compute_amplitudes(const std::vector<Sample> &signal, const bool oscillating)
    {
      if (oscillating)
        return compute_envelope(signal);
      std::vector<Sample> result;
      for (const auto &sample : signal)
        if (sample.value != 0.)
          result.push_back({ sample.time, std::abs(sample.value) });
      return result;
    }

    void fit(const std::vector<Sample> &signal, const Eigenmode &mode, const double at_start, Growth &growth)
    {
      growth.sizes     = compute_amplitudes(signal, oscillates(mode));
      growth.envelope  = fit_exponential(growth.sizes);
      growth.frequency = oscillates(mode) ? fit_frequency(crossings(signal)) : std::numeric_limits<double>::quiet_NaN();
      for (auto &size : growth.sizes)
        size.value *= at_start / growth.envelope.amplitude;
    }
  } // namespace

  const Eigenmode &watched_mode(const SlideStability &stability)
  {
    if (stability.kind != SlideKind::stable)
      return stability.worst_mode();
    // Without damping none decays: the lowest then, which comes first.
    const Eigenmode *slowest = nullptr;
    for (const auto &mode : stability.modes)
    {
      const double round_off = smallest_growth * std::abs(mode.mode.eigenvalue);
      const auto rate        = [](const Eigenmode &other) { return other.mode.eigenvalue.real(); };
      if (oscillates(mode) && (slowest == nullptr || rate(mode) > rate(*slowest) + round_off))
        slowest = &mode;
    }
    return slowest != nullptr ? *slowest : stability.worst_mode();
  }

  double choose_step(const Eigenmode &mode, const SpragSlipSettings &settings)
  {
    return mode_period(mode) / settings.steps_per_period;
  }

  Growth measure_growth(DynamicModel &model, const SlideStability &stability, const SpragSlipSettings &settings, HeldRun &run,
                        const RowSink &sink)
  {
    const auto &slide     = *stability.slide;
    const auto &mode      = watched_mode(stability);
    const bool grows      = stability.kind != SlideKind::stable;
    const double at_start = grows ? settings.initial : settings.final;
    const double at_end   = grows ? settings.final : settings.initial;
    const double period   = mode_period(mode);

    Growth growth;
    growth.eigenvalue = mode.mode.eigenvalue;
    run.begin(model.perturbed(slide, mode, at_start * slide.penetration));
    const auto path    = held_path(run.drive(), slide);
    const double begin = run.drive().time;
    AmplitudeWatch watch{ 0.5 * period, at_end / at_start };
    std::vector<Sample> signal;
    for (double time = 0.; !growth.reached && growth.slid && time < settings.longest_growth;)
    {
      const Row &row = run.step(path);
      sink(row);
      time                = row[Column::time] - begin;
      const Sample sample = { time, row[Column::P] - slide.forces.P };
      growth.reached      = watch.reached(sample);
      growth.slid         = run.slides(slide.speed) && row[Column::P] > 0.;
      if (time > settled_after * period)
        signal.push_back(sample);
    }
    fit(signal, mode, at_start, growth);
    return growth;
  }
} // namespace sprag
