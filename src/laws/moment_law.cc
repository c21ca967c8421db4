#include "laws/moment_law.h"

#include <algorithm>

namespace sprag
{
  namespace
  {
    using Sample = MomentLaw::Sample;

    /// Between two samples, in t = 0 ... 1.
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

    /// Index of the sample after which a turn within the samples lies.
    std::size_t interval(const std::vector<Sample> &samples, const double turn)
    {
      const auto after = std::upper_bound(samples.begin(), samples.end(), turn,
                                          [](const double value, const Sample &sample) { return value < sample.turn; });
      const auto index = static_cast<std::size_t>(after - samples.begin());
      return std::clamp<std::size_t>(index, 1, samples.size() - 1) - 1;
    }
  } // namespace

  MomentLaw::MomentLaw(const double stiffness_at_rest, std::vector<Sample> samples)
      : k(stiffness_at_rest)
      , excess_samples(samples)
      , given(std::move(samples))
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

  bool MomentLaw::is_linear() const
  {
    return excess_samples.size() < 2;
  }

  double MomentLaw::linear_stiffness() const
  {
    return k;
  }

  double MomentLaw::excess(const double turn) const
  {
    if (is_linear())
      return 0.;
    const Sample &first = excess_samples.front();
    const Sample &last  = excess_samples.back();
    if (turn < first.turn || turn > last.turn)
    {
      const Sample &end = turn < first.turn ? first : last;
      return end.moment + end.stiffness * (turn - end.turn);
    }
    const auto i = interval(excess_samples, turn);
    const Cubic cubic(excess_samples[i], excess_samples[i + 1]);
    return cubic.value((turn - excess_samples[i].turn) / cubic.width);
  }

  double MomentLaw::excess_stiffness(const double turn) const
  {
    if (is_linear())
      return 0.;
    const Sample &first = excess_samples.front();
    const Sample &last  = excess_samples.back();
    if (turn < first.turn || turn > last.turn)
      return (turn < first.turn ? first : last).stiffness;
    const auto i = interval(excess_samples, turn);
    const Cubic cubic(excess_samples[i], excess_samples[i + 1]);
    return cubic.derivative((turn - excess_samples[i].turn) / cubic.width);
  }

  double MomentLaw::excess_energy(const double turn) const
  {
    if (is_linear())
      return 0.;
    const Sample &first = excess_samples.front();
    const Sample &last  = excess_samples.back();
    if (turn < first.turn || turn > last.turn)
    {
      const bool below  = turn < first.turn;
      const Sample &end = below ? first : last;
      const double more = turn - end.turn;
      return (below ? energies.front() : energies.back()) + more * (end.moment + 0.5 * end.stiffness * more);
    }
    const auto i = interval(excess_samples, turn);
    const Cubic cubic(excess_samples[i], excess_samples[i + 1]);
    return energies[i] + cubic.integral((turn - excess_samples[i].turn) / cubic.width);
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
    return given;
  }
} // namespace sprag
