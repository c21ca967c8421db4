// SPDX-License-Identifier: GPL-3.0-only
#include "model/step/force_history.h"

#include "model/step/state_archive.h"

#include <algorithm>
#include <array>
#include <numeric>

namespace sprag
{
  namespace
  {
    constexpr std::size_t most = 3; // a cubic follows the noise of points that come and go

    using Shares = std::array<double, most>;

    /// Shares of the values at the first n steps, which differ, in that of the polynomial through them at another, by Lagrange.
    Shares shares_at(const double time, const std::vector<ForcesAtTime> &steps, const std::size_t n)
    {
      Shares result{};
      for (std::size_t i = 0; i < n; ++i)
      {
        result[i] = 1.;
        for (std::size_t j = 0; j < n; ++j)
          if (j != i)
            result[i] *= (time - steps[j].time) / (steps[i].time - steps[j].time);
      }
      return result;
    }
  } // namespace

  void ForceHistory::begin(const DofLoads &forces)
  {
    time  = 0.;
    steps = { { forces, time } };
  }

  void ForceHistory::accept(const DofLoads &forces, const double duration)
  {
    if (steps.size() == most)
      steps.pop_back();
    steps.insert(steps.begin(), { forces, time + 0.5 * duration });
    time += duration;
  }

  DofLoads ForceHistory::guess(const double duration) const
  {
    std::array<Shares, most + 1> shares{}; // of polynomials through so many steps
    for (std::size_t n = 1; n <= steps.size(); ++n)
      shares[n] = shares_at(time + 0.5 * duration, steps, n);
    std::array<unsigned int, most> next{}; // of the dofs at each place
    DofLoads result = steps.front().forces;
    for (unsigned int i = 0; i < result.dofs.size(); ++i)
    {
      Shares values{};
      std::size_t n = 0;
      for (; n < steps.size(); ++n)
      {
        const auto &[dofs, dof_values] = steps[n].forces;
        while (next[n] < dofs.size() && dofs[next[n]] < result.dofs[i])
          ++next[n];
        if (next[n] == dofs.size() || dofs[next[n]] != result.dofs[i])
          break;
        values[n] = dof_values[next[n]];
      }
      result.values[i] = std::inner_product(values.begin(), values.begin() + n, shares[n].begin(), 0.);
    }
    return result;
  }

  SPRAG_SERIALISE(ForcesAtTime, forces, time)

  SPRAG_SERIALISE(ForceHistory, steps, time)
} // namespace sprag
