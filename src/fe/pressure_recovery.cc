#include "fe/pressure_recovery.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>

namespace sprag
{
  namespace
  {
    constexpr std::size_t fewest_samples = 10;
    constexpr double largest_misfit      = 0.25; ///< root mean square over that of the pressure
    constexpr std::size_t enough_samples = 48;

    struct Range
    {
      std::size_t begin;
      std::size_t end; ///< beyond the last
    };

    /// Samples under pressure; gaps of less than a fifth of the whole are dents.
    std::optional<Range> single_contact(const PressureSamples &samples)
    {
      const auto &p     = samples.pressure;
      std::size_t first = p.size(), last = 0, closed = 0;
      for (std::size_t i = 0; i < p.size(); ++i)
        if (p[i] > 0.)
        {
          first = std::min(first, i);
          last  = i;
          ++closed;
        }
      if (closed < fewest_samples || 5 * (last + 1 - first - closed) > last + 1 - first)
        return {};
      const double spacing = (samples.xi[last] - samples.xi[first]) / static_cast<double>(last - first);
      if (samples.xi[first] - samples.begin < 2. * spacing || samples.end - samples.xi[last] < 2. * spacing)
        return {};
      return Range{ first, last + 1 };
    }

    /// (1 - s^2)^(m/4)
    double edge(const double s, const int quarters)
    {
      const double inside = 1. - s * s;
      if (inside <= 0.)
        return 0.;
      const double root = std::sqrt(inside);
      return quarters == 2 ? root : quarters == 3 ? root * std::sqrt(root) : inside;
    }

    struct Fit
    {
      double a = 0., b = 0.;
      int quarters = 2; ///< 4 m
      std::array<double, 3> c{};
      double misfit = std::numeric_limits<double>::infinity(); ///< integral of its square

      double s(const double xi) const
      {
        return (2. * xi - a - b) / (b - a);
      }
      double pressure(const double xi) const
      {
        const double at = s(xi);
        return edge(at, quarters) * (c[0] + at * (c[1] + at * c[2]));
      }
    };

    /// Coefficients that give the samples' first three moments.
    std::array<double, 3> coefficients(const PressureSamples &samples, const Range &range, const Fit &fit)
    {
      std::array<double, 5> of_edge{};
      std::array<double, 3> of_samples{};
      for (std::size_t i = range.begin; i < range.end; ++i)
      {
        const double s   = fit.s(samples.xi[i]);
        double of_power  = samples.weight[i] * edge(s, fit.quarters);
        double of_sample = samples.weight[i] * samples.pressure[i];
        for (unsigned int k = 0; k < 5; ++k, of_power *= s)
          of_edge[k] += of_power;
        for (unsigned int k = 0; k < 3; ++k, of_sample *= s)
          of_samples[k] += of_sample;
      }
      const auto determinant = [](const std::array<std::array<double, 3>, 3> &m)
      {
        return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) - m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
               m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
      };
      std::array<std::array<double, 3>, 3> matrix;
      for (unsigned int j = 0; j < 3; ++j)
        for (unsigned int k = 0; k < 3; ++k)
          matrix[j][k] = of_edge[j + k];
      const double whole = determinant(matrix);
      std::array<double, 3> result;
      for (unsigned int k = 0; k < 3; ++k)
      {
        auto replaced = matrix;
        for (unsigned int j = 0; j < 3; ++j)
          replaced[j][k] = of_samples[j];
        result[k] = determinant(replaced) / whole;
      }
      return result;
    }

    Fit fitted(const PressureSamples &samples, const Range &range, const double a, const double b, const int quarters)
    {
      Fit fit;
      fit.a        = a;
      fit.b        = b;
      fit.quarters = quarters;
      fit.c        = coefficients(samples, range, fit);
      fit.misfit   = 0.;
      for (std::size_t i = range.begin; i < range.end; ++i)
      {
        const double off = fit.pressure(samples.xi[i]) - samples.pressure[i];
        fit.misfit += samples.weight[i] * off * off;
      }
      return fit;
    }

    /// Fewer samples, each the mean of some: the search for the ends needs no more.
    PressureSamples thinned(const PressureSamples &samples, const Range &range)
    {
      PressureSamples result;
      const std::size_t together = 1 + (range.end - range.begin) / enough_samples;
      for (std::size_t i = range.begin; i < range.end; i += together)
      {
        double area = 0., force = 0., moment = 0.;
        for (std::size_t k = i; k < std::min(i + together, range.end); ++k)
        {
          area += samples.weight[k];
          force += samples.weight[k] * samples.pressure[k];
          moment += samples.weight[k] * samples.xi[k];
        }
        result.xi.push_back(moment / area);
        result.weight.push_back(area);
        result.pressure.push_back(force / area);
      }
      return result;
    }

    /// Moves both ends of the contact by turns, in shares of its length that halve.
    Fit with_best_ends(const PressureSamples &samples, Fit best, double share, const unsigned int halvings)
    {
      const Range all{ 0, samples.xi.size() };
      for (unsigned int i = 0; i < halvings; ++i, share *= 0.5)
        for (const auto &[left, right] : { std::pair{ 1., 0. }, { 0., 1. } })
          for (const double way : { -1., 1. })
            for (unsigned int times = 0; times < 3; ++times)
            {
              const double move = way * share * (best.b - best.a);
              const Fit next    = fitted(samples, all, best.a + move * left, best.b + move * right, best.quarters);
              if (!(next.misfit < best.misfit))
                break;
              best = next;
            }
      return best;
    }

    bool is_positive(const Fit &fit)
    {
      const auto value = [&](const double s) { return fit.c[0] + s * (fit.c[1] + s * fit.c[2]); };
      const double low = fit.c[2] > 0. ? -0.5 * fit.c[1] / fit.c[2] : 0.;
      return value(-1.) >= 0. && value(1.) >= 0. && (std::abs(low) > 1. || value(low) >= 0.);
    }

    /// Of the samples, edges linear between one under pressure and one that is not.
    RecoveredPressure as_sampled(const PressureSamples &samples)
    {
      RecoveredPressure result;
      result.pressure = samples.pressure;
      for (std::size_t i = 0; i < samples.xi.size(); ++i)
      {
        const double p = samples.pressure[i];
        if (p > result.largest)
        {
          result.largest = p;
          result.place   = samples.xi[i];
        }
      }
      return result;
    }
  } // namespace

  RecoveredPressure recover(const PressureSamples &samples)
  {
    auto result        = as_sampled(samples);
    const auto contact = single_contact(samples);
    if (!contact)
      return result;
    const double a = samples.xi[contact->begin], b = samples.xi[contact->end - 1];
    const double half_spacing = 0.5 * (b - a) / static_cast<double>(contact->end - 1 - contact->begin);
    // Ends may move outwards over samples without pressure.
    const auto aside = (contact->end - contact->begin) / 4 + 2;
    const Range near{ contact->begin - std::min(aside, contact->begin), std::min(contact->end + aside, samples.xi.size()) };
    const auto few = thinned(samples, near);
    Fit best;
    const auto start = with_best_ends(few, fitted(few, { 0, few.xi.size() }, a - half_spacing, b + half_spacing, 3), 0.04, 6);
    for (const int quarters : { 2, 3, 4 })
      if (const Fit fit = with_best_ends(few, fitted(few, { 0, few.xi.size() }, start.a, start.b, quarters), 0.02, 5);
          fit.misfit < best.misfit && is_positive(fit))
        best = fit;
    if (!std::isfinite(best.misfit))
      return result;
    best        = fitted(samples, near, best.a, best.b, best.quarters);
    double size = 0.;
    for (std::size_t i = near.begin; i < near.end; ++i)
      size += samples.weight[i] * samples.pressure[i] * samples.pressure[i];
    if (!is_positive(best) || !(best.misfit < largest_misfit * largest_misfit * size))
      return result;

    result.is_fitted = true;
    result.width     = best.b - best.a;
    result.largest   = 0.;
    for (std::size_t i = 0; i < samples.xi.size(); ++i)
      result.pressure[i] = best.pressure(samples.xi[i]);
    constexpr unsigned int places = 400;
    for (unsigned int i = 1; i < places; ++i)
    {
      const double xi = best.a + (best.b - best.a) * i / places;
      if (const double p = best.pressure(xi); p > result.largest)
      {
        result.largest = p;
        result.place   = xi;
      }
    }
    return result;
  }
} // namespace sprag
