// SPDX-License-Identifier: GPL-3.0-only
#include "analysis/transient/envelope.h"

#include "base/least_squares.h"
#include "base/unknown.h"

#include <cmath>
#include <numeric>

namespace sprag
{
  namespace
  {
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
