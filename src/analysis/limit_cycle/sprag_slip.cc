// SPDX-License-Identifier: GPL-3.0-only
#include "analysis/limit_cycle/sprag_slip.h"

#include "base/least_squares.h"
#include "base/unknown.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

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

    /// Vertex of the parabola through three samples, the middle one not smaller than its neighbours.
    Sample vertex(const Sample &before, const Sample &middle, const Sample &after)
    {
      const double h0     = middle.time - before.time;
      const double h1     = after.time - middle.time;
      const double rise   = (middle.value - before.value) / h0;
      const double fall   = (after.value - middle.value) / h1;
      const double bend   = (fall - rise) / (h0 + h1);
      const double slope  = (rise * h1 + fall * h0) / (h0 + h1);
      const double offset = bend < 0. ? -slope / (2. * bend) : 0.;
      return { middle.time + offset, middle.value + 0.5 * slope * offset };
    }

    Sample sized(const Sample &sample)
    {
      return { sample.time, std::abs(sample.value) };
    }

    bool changes_sign(const Sample &a, const Sample &b)
    {
      return (a.value < 0.) != (b.value < 0.);
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

  std::vector<Sample> compute_envelope(const std::vector<Sample> &signal)
  {
    std::vector<Sample> result;
    std::size_t largest = 0;
    bool inside         = false;
    for (std::size_t i = 1; i < signal.size(); ++i)
    {
      if (changes_sign(signal[i - 1], signal[i]))
      {
        if (inside)
          result.push_back(vertex(sized(signal[largest - 1]), sized(signal[largest]), sized(signal[largest + 1])));
        inside  = true;
        largest = i;
      }
      else if (std::abs(signal[i].value) > std::abs(signal[largest].value))
        largest = i;
    }
    return result;
  }

  std::vector<double> crossings(const std::vector<Sample> &signal)
  {
    std::vector<double> result;
    for (std::size_t i = 1; i < signal.size(); ++i)
    {
      const auto &a = signal[i - 1];
      const auto &b = signal[i];
      if (changes_sign(a, b))
        result.push_back(a.time + (b.time - a.time) * a.value / (a.value - b.value));
    }
    return result;
  }

  ExponentialFit fit_exponential(const std::vector<Sample> &sizes)
  {
    if (sizes.size() < 3)
      return { unknown, unknown, unknown };
    std::vector<double> times, logarithms;
    for (const auto &size : sizes)
    {
      times.push_back(size.time);
      logarithms.push_back(std::log(size.value));
    }
    const auto line = fitted_line(times, logarithms);
    double squares  = 0.;
    for (std::size_t i = 0; i < times.size(); ++i)
      squares += std::pow(logarithms[i] - line.at(times[i]), 2);
    return { line.slope, std::exp(line.at(0.)), std::sqrt(squares / static_cast<double>(sizes.size())) };
  }

  double fit_frequency(const std::vector<double> &times)
  {
    if (times.size() < 3)
      return unknown;
    std::vector<double> numbers(times.size());
    std::iota(numbers.begin(), numbers.end(), 0.);
    return 0.5 / fitted_line(numbers, times).slope;
  }
} // namespace sprag
