// SPDX-License-Identifier: GPL-3.0-only
#include "analytic/steady_state.h"

#include <algorithm>
#include <cmath>

namespace sprag
{
  void SteadyState::add(const double z, const double rate_over_frequency, const double amplitude)
  {
    instants.push_back({ z, rate_over_frequency, amplitude });
  }

  double SteadyState::change(const std::size_t instant, const unsigned int periods) const
  {
    const auto &now = instants[instant], &before = instants[instant - periods];
    return std::hypot(now.z - before.z, now.rate - before.rate);
  }

  bool SteadyState::repeats(const std::size_t instant, const unsigned int periods, const double tolerance) const
  {
    constexpr double round_off = 1e-13;
    const double last = change(instant, periods), before = change(instant - periods, periods);
    const double amplitude = instants[instant].amplitude;
    if (last <= round_off * amplitude)
      return true;
    const double ratio = last / before;
    return ratio < 1. && last * ratio / (1. - ratio) <= tolerance * amplitude && last <= 1e3 * tolerance * amplitude;
  }

  /// A decay that turns seems to repeat after several periods first; close to the steady state all that is left is small.
  unsigned int SteadyState::shortest(const unsigned int repeating, const double tolerance) const
  {
    const std::size_t last = instants.size() - 1;
    for (unsigned int p = 1; p < repeating; ++p)
      if (repeating % p == 0 && change(last, p) <= 4. * tolerance * instants[last].amplitude)
        return p;
    return repeating;
  }

  std::optional<unsigned int> SteadyState::periods(const double tolerance) const
  {
    constexpr unsigned int most = 8;
    for (unsigned int p = 1; p <= most && 2 * p + 2 <= instants.size(); ++p)
      if (repeats(instants.size() - 1, p, tolerance) && repeats(instants.size() - 2, p, tolerance))
        return shortest(p, tolerance);
    return {};
  }

  void visit(Archive &archive, SteadyState &steady)
  {
    archive(steady.instants);
  }
} // namespace sprag
