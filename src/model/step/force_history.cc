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

    /// Shares of the values at the first n places, which differ, in that of the polynomial through them at another, by Lagrange.
    Shares shares_at(const double place, const std::vector<ForcesAtPlace> &places, const std::size_t n)
    {
      Shares result{};
      for (std::size_t i = 0; i < n; ++i)
      {
        result[i] = 1.;
        for (std::size_t j = 0; j < n; ++j)
          if (j != i)
            result[i] *= (place - places[j].place) / (places[i].place - places[j].place);
      }
      return result;
    }
  } // namespace

  void ForceHistory::begin(const DofLoads &forces)
  {
    time   = 0.;
    places = { { forces, time } };
  }

  void ForceHistory::accept(const DofLoads &forces, const double duration)
  {
    accept_at(forces, time + 0.5 * duration);
    time += duration;
  }

  void ForceHistory::guess(const double duration, DofLoads &result) const
  {
    result = guess_at(time + 0.5 * duration);
  }

  void ForceHistory::accept_at(const DofLoads &forces, const double place, const bool goes_on)
  {
    if (!goes_on)
      places.clear();
    if (places.size() == most)
      places.pop_back();
    places.insert(places.begin(), { forces, place });
  }

  DofLoads ForceHistory::guess_at(const double place) const
  {
    std::array<Shares, most + 1> shares{}; // of polynomials through so many places
    for (std::size_t n = 1; n <= places.size(); ++n)
      shares[n] = shares_at(place, places, n);
    std::array<unsigned int, most> next{}; // of the dofs at each place
    DofLoads result = places.front().forces;
    for (unsigned int i = 0; i < result.dofs.size(); ++i)
    {
      Shares values{};
      std::size_t n = 0;
      for (; n < places.size(); ++n)
      {
        const auto &[dofs, dof_values] = places[n].forces;
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

  SPRAG_SERIALISE(ForcesAtPlace, forces, place)

  SPRAG_SERIALISE(ForceHistory, places, time)
} // namespace sprag
