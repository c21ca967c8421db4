// SPDX-License-Identifier: GPL-3.0-only
#include "analytic/error_estimate.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace sprag
{
  double total_error(const ErrorEstimate &estimate)
  {
    if (estimate.parts.empty())
      return std::numeric_limits<double>::quiet_NaN();
    return std::accumulate(estimate.parts.begin(), estimate.parts.end(), 0.,
                           [](const double sum, const ErrorPart &part) { return sum + part.value; });
  }

  const ErrorPart &largest_part(const ErrorEstimate &estimate)
  {
    return *std::max_element(estimate.parts.begin(), estimate.parts.end(),
                             [](const ErrorPart &a, const ErrorPart &b) { return a.value < b.value; });
  }

  double finer_share(const double ratio, const double order)
  {
    return 1. / (std::pow(ratio, order) - 1.);
  }
} // namespace sprag
