// SPDX-License-Identifier: GPL-3.0-only
#pragma once

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
} // namespace sprag
