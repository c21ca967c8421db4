// SPDX-License-Identifier: GPL-3.0-only
#include "run/stress_comparison.h"

#include "results/row_statistics.h"

#include <algorithm>
#include <cmath>

namespace sprag
{
  namespace
  {
    constexpr double near_peak = 0.5;  ///< stress of the states that count, over the largest
    constexpr double near_edge = 0.85; ///< stress at the contact's edge over the largest, from which a finer mesh finds it there
  }                                    // namespace

  StressComparison::StressComparison(const StaticLever<2> &other, const std::vector<StressSample> &run)
      : model(other)
      , samples(run)
      , fields(model.body())
  {
  }

  void StressComparison::look_at(const State &state, const Row &row)
  {
    const auto of_run =
        std::find_if(samples.begin(), samples.end(), [&](const StressSample &sample) { return sample.time == state.drive.time; });
    if (of_run == samples.end())
      return;
    StressSample found;
    for (const auto &displacement : model.body_displacements(state.coordinates, state.forces))
      sprag::look_at(fields, fields.at(displacement), row, found);
    pairs.push_back({ *of_run, found });
  }

  std::optional<StressChanges> StressComparison::changes() const
  {
    const auto change = [&](double StressSample::*const part)
    {
      const double peak = largest(pairs, [&](const Pair &pair) { return pair.run.*part; });
      double result     = 0.;
      for (const auto &[run, other] : pairs)
        if (run.*part >= near_peak * peak)
          result = std::max(result, std::abs(other.*part - run.*part));
      return peak > 0. ? result / peak : 0.;
    };
    if (pairs.empty())
      return {};
    const auto peak =
        std::max_element(pairs.begin(), pairs.end(), [](const Pair &a, const Pair &b) { return a.run.layer < b.run.layer; });
    return StressChanges{ change(&StressSample::lever), change(&StressSample::layer),
                          peak->run.layer_edge > near_edge * peak->run.layer };
  }

  std::vector<double> times_of(const std::vector<StressSample> &samples)
  {
    std::vector<double> times;
    for (const auto &sample : samples)
      times.push_back(sample.time);
    return times;
  }
} // namespace sprag
