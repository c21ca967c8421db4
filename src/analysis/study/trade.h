// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include <optional>
#include <vector>

namespace sprag
{
  // Trade between cost and error of runs; NaN stands for an unknown cost or error.

  /// Returns for each run whether nobody is better: no other costs at most as much and is at most as far off, one of them less. A
  /// run without cost or error is none of these.
  std::vector<bool> pareto_front(const std::vector<double> &costs, const std::vector<double> &errors);

  /// Returns the index of the cheapest run with an error of at most `accuracy`, the first of those that cost the same.
  std::optional<std::size_t> cheapest_within(double accuracy, const std::vector<double> &costs,
                                             const std::vector<double> &errors);

  /// Returns the order p of error = C size^p, a fit of least squares to the logarithms of all pairs > 0; NaN where they have
  /// fewer than three sizes.
  double observed_order(const std::vector<double> &sizes, const std::vector<double> &errors);
} // namespace sprag
