// SPDX-License-Identifier: GPL-3.0-only
#include "analysis/study/trade.h"

#include "base/least_squares.h"

#include <cmath>
#include <limits>
#include <set>

namespace sprag
{
  std::vector<bool> pareto_front(const std::vector<double> &costs, const std::vector<double> &errors)
  {
    const auto beats = [&](const std::size_t other, const std::size_t run)
    {
      return costs[other] <= costs[run] && errors[other] <= errors[run] &&
             (costs[other] < costs[run] || errors[other] < errors[run]);
    };
    std::vector<bool> front;
    for (std::size_t run = 0; run < costs.size(); ++run)
    {
      bool best = std::isfinite(costs[run]) && std::isfinite(errors[run]);
      for (std::size_t other = 0; best && other < costs.size(); ++other)
        best = !beats(other, run);
      front.push_back(best);
    }
    return front;
  }

  std::optional<std::size_t> cheapest_within(const double accuracy, const std::vector<double> &costs,
                                             const std::vector<double> &errors)
  {
    std::optional<std::size_t> found;
    for (std::size_t run = 0; run < costs.size(); ++run)
      if (errors[run] <= accuracy && std::isfinite(costs[run]) && (!found || costs[run] < costs[*found]))
        found = run;
    return found;
  }

  double observed_order(const std::vector<double> &sizes, const std::vector<double> &errors)
  {
    std::vector<double> x, y;
    for (std::size_t i = 0; i < sizes.size(); ++i)
      if (sizes[i] > 0. && errors[i] > 0. && std::isfinite(sizes[i]) && std::isfinite(errors[i]))
      {
        x.push_back(std::log(sizes[i]));
        y.push_back(std::log(errors[i]));
      }
    const bool enough = std::set<double>(x.begin(), x.end()).size() >= 3;
    return enough ? fitted_line(x, y).slope : std::numeric_limits<double>::quiet_NaN();
  }
} // namespace sprag
