// SPDX-License-Identifier: GPL-3.0-only
#include "base/local_regression.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace sprag
{
  namespace
  {
    constexpr std::ptrdiff_t fewest_points = 4;
    constexpr double rounding              = 1e-9;

    double determinant(const double a, const double b, const double c, const double d, const double e, const double f,
                       const double g, const double h, const double i)
    {
      return a * (e * i - f * h) - b * (d * i - f * g) + c * (d * h - e * g);
    }

    /// The constant of the weighted parabola about `x0`, relative to `y0`.
    double fitted_at(const double x0, const double y0, const double half_width, const double *x, const double *y,
                     const std::ptrdiff_t n)
    {
      std::array<double, 5> s{};
      std::array<double, 3> t{};
      for (std::ptrdiff_t j = 0; j < n; ++j)
      {
        const double u      = (x[j] - x0) / half_width;
        const double weight = std::pow(std::max(0., 1. - std::pow(std::abs(u), 3)), 3);
        double term         = weight;
        for (std::size_t power = 0; power < s.size(); ++power, term *= u)
        {
          s[power] += term;
          if (power < t.size())
            t[power] += term * (y[j] - y0);
        }
      }
      return determinant(t[0], s[1], s[2], t[1], s[2], s[3], t[2], s[3], s[4]) /
             determinant(s[0], s[1], s[2], s[1], s[2], s[3], s[2], s[3], s[4]);
    }
  } // namespace

  std::vector<double> locally_fitted(const std::vector<double> &x, const std::vector<double> &y, const double width)
  {
    const auto [lowest, highest] = std::minmax_element(y.begin(), y.end());
    const double unit            = rounding * (*highest - *lowest);
    std::vector<double> result   = y;
    auto begin                   = x.begin();
    auto end                     = x.begin();
    for (std::size_t i = 0; i < x.size() && unit > 0.; ++i)
    {
      // A point at the window's edge has no weight.
      while (*begin < x[i] && *begin <= x[i] - 0.5 * width)
        ++begin;
      while (end != x.end() && *end < x[i] + 0.5 * width)
        ++end;
      const auto first = begin - x.begin();
      if (end - begin >= fewest_points)
        result[i] += std::round(fitted_at(x[i], y[i], 0.5 * width, &x[first], &y[first], end - begin) / unit) * unit;
    }
    return result;
  }
} // namespace sprag
