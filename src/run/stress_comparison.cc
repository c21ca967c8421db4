#include "run/stress_comparison.h"

#include "results/row_statistics.h"

#include <algorithm>
#include <cmath>

namespace sprag
{
  namespace
  {
    constexpr double near_peak = 0.5; ///< stress of the states that count, over the largest
  }

  StressComparison::StressComparison(const LeverModel &other, const std::vector<StressSample> &run)
      : model(other)
      , samples(run)
      , fields(model.elastic_body())
      , peaks(fields)
  {
  }

  void StressComparison::look_at(const State &state)
  {
    const auto of_run =
        std::find_if(samples.begin(), samples.end(), [&](const StressSample &sample) { return sample.time == state.drive.time; });
    if (of_run == samples.end())
      return;
    StressSample found{ state.drive.time, 0., 0. };
    for (const auto &displacement : model.body_displacements(state))
    {
      const auto largest = peaks.look_at(fields.at(displacement), state.drive.x, 0, 0);
      found.lever        = std::max(found.lever, largest[0]);
      found.layer        = std::max(found.layer, largest[1]);
    }
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
    return StressChanges{ change(&StressSample::lever), change(&StressSample::layer) };
  }

  std::vector<double> times_of(const std::vector<StressSample> &samples)
  {
    std::vector<double> times;
    for (const auto &sample : samples)
      times.push_back(sample.time);
    return times;
  }
} // namespace sprag
