// SPDX-License-Identifier: GPL-3.0-only
#include "laws/moment_law.h"

#include <algorithm>

namespace sprag
{
  namespace
  {
    using Sample = MomentLaw::Sample;

    /// The cubic between two samples, in t = 0 ... 1.
    struct Cubic
    {
      double width;
      double a, b, c, d; ///< a + b t + c t^2 + d t^3

      Cubic(const Sample &from, const Sample &to)
          : width(to.turn - from.turn)
          , a(from.moment)
          , b(width * from.stiffness)
          , c(3. * (to.moment - from.moment) - width * (2. * from.stiffness + to.stiffness))
          , d(-2. * (to.moment - from.moment) + width * (from.stiffness + to.stiffness))
      {
      }

      double value(const double t) const
      {
        return a + t * (b + t * (c + t * d));
      }
      double derivative(const double t) const
      {
        return (b + t * (2. * c + t * 3. * d)) / width;
      }
      double integral(const double t) const
      {
        return width * t * (a + t * (b / 2. + t * (c / 3. + t * d / 4.)));
      }
    };

    /// Returns the index of the last sample before a turn within the samples.
    std::size_t interval(const std::vector<Sample> &samples, const double turn)
    {
      const auto after = std::upper_bound(samples.begin(), samples.end(), turn,
                                          [](const double value, const Sample &sample) { return value < sample.turn; });
      const auto index = static_cast<std::size_t>(after - samples.begin());
      return std::clamp<std::size_t>(index, 1, samples.size() - 1) - 1;
    }

    /// Returns between samples `inside`(cubic, place on it from 0 to 1, number of the sample before), beyond them `outside`(the
    /// last sample on that side, turn beyond it, its number); 0 where there are none to go between.
    template <class Inside, class Outside>
    double evaluated(const std::vector<Sample> &samples, const double turn, const Inside &inside, const Outside &outside)
    {
      if (samples.size() < 2)
        return 0.;
      for (const std::size_t end : { std::size_t(0), samples.size() - 1 })
        if (end == 0 ? turn < samples[end].turn : turn > samples[end].turn)
          return outside(samples[end], turn - samples[end].turn, end);
      const auto i = interval(samples, turn);
      const Cubic cubic(samples[i], samples[i + 1]);
      return inside(cubic, (turn - samples[i].turn) / cubic.width, i);
    }
  } // namespace

  MomentLaw::MomentLaw(const double stiffness_at_rest, std::vector<Sample> samples)
      : k(stiffness_at_rest)
      , excess_samples(samples)
      , tabulated(std::move(samples))
  {
    for (auto &sample : excess_samples)
    {
      sample.moment -= k * sample.turn;
      sample.stiffness -= k;
    }
    energies.assign(excess_samples.size(), 0.);
    for (std::size_t i = 1; i < excess_samples.size(); ++i)
      energies[i] = energies[i - 1] + Cubic(excess_samples[i - 1], excess_samples[i]).integral(1.);
    if (excess_samples.empty())
      return;
    const double at_rest = excess_energy(0.);
    for (auto &energy : energies)
      energy -= at_rest;
  }

  MomentLaw MomentLaw::at_rest_at(const double turn) const
  {
    MomentLaw result = *this;
    result.rest      = turn;
    return result;
  }

  MomentLaw MomentLaw::times(const double factor) const
  {
    if (factor == 1.)
      return *this;
    auto scaled = tabulated.empty() ? std::vector<Sample>{ { -1., -k, k }, { 0., 0., k }, { 1., k, k } } : tabulated;
    for (auto &sample : scaled)
    {
      sample.moment *= factor;
      sample.stiffness *= factor;
    }
    return MomentLaw(k, std::move(scaled)).at_rest_at(rest);
  }

  bool MomentLaw::is_linear() const
  {
    return excess_samples.size() < 2 && rest == 0.;
  }

  double MomentLaw::linear_stiffness() const
  {
    return k;
  }

  double MomentLaw::excess(const double turn) const
  {
    return evaluated(
               excess_samples, turn - rest,
               [](const Cubic &cubic, const double place, std::size_t) { return cubic.value(place); },
               [](const Sample &end, const double beyond, std::size_t) { return end.moment + end.stiffness * beyond; }) -
           k * rest;
  }

  double MomentLaw::excess_stiffness(const double turn) const
  {
    return evaluated(
        excess_samples, turn - rest, [](const Cubic &cubic, const double place, std::size_t) { return cubic.derivative(place); },
        [](const Sample &end, double, std::size_t) { return end.stiffness; });
  }

  double MomentLaw::excess_energy(const double turn) const
  {
    return evaluated(
               excess_samples, turn - rest,
               [&](const Cubic &cubic, const double place, const std::size_t i) { return energies[i] + cubic.integral(place); },
               [&](const Sample &end, const double beyond, const std::size_t i)
               { return energies[i] + beyond * (end.moment + 0.5 * end.stiffness * beyond); }) +
           k * rest * (0.5 * rest - turn);
  }

  double MomentLaw::moment(const double turn) const
  {
    return k * turn + excess(turn);
  }

  double MomentLaw::stiffness(const double turn) const
  {
    return k + excess_stiffness(turn);
  }

  double MomentLaw::energy(const double turn) const
  {
    return 0.5 * k * turn * turn + excess_energy(turn);
  }

  const std::vector<Sample> &MomentLaw::samples() const
  {
    return tabulated;
  }
} // namespace sprag
