// SPDX-License-Identifier: GPL-3.0-only
#include "base/monotone_cubic.h"

#include "base/errors.h"
#include "base/text.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <initializer_list>

// Boost 1.74 calls isnan without its namespace, which only this header provides.
#include <math.h>

#include <boost/math/interpolators/cubic_hermite.hpp>
#include <boost/math/interpolators/pchip.hpp>

namespace sprag
{
  namespace
  {
    void check_points(const std::vector<double> &x, const std::vector<double> &y)
    {
      if (x.size() != y.size())
        throw InputError("both columns must have the same number of rows");
      if (x.size() < 4)
        throw InputError("has " + std::to_string(x.size()) + " rows: must have at least 4");
      for (std::size_t i = 0; i < x.size(); ++i)
      {
        const std::string row = "row " + std::to_string(i + 1) + ": ";
        if (!std::isfinite(x[i]) || !std::isfinite(y[i]))
          throw InputError(row + "must hold finite numbers");
        if (i > 0 && x[i] <= x[i - 1])
          throw InputError(row + number_text(x[i]) + " follows " + number_text(x[i - 1]) +
                           ": the first column must increase from row to row");
      }
    }

    /// Returns the derivative at x[i] of the polynomial through the points from `begin` to before `end`.
    double polynomial_slope(const std::vector<double> &x, const std::vector<double> &y, const std::size_t i,
                            const std::size_t begin, const std::size_t end)
    {
      double result = 0.;
      for (std::size_t j = begin; j < end; ++j)
      {
        double weight = j == i ? 0. : 1. / (x[j] - x[i]);
        for (std::size_t k = begin; k < end; ++k)
          if (k != i && k != j)
            weight *= (x[i] - x[k]) / (x[j] - x[k]);
        result += weight * (y[j] - y[i]);
      }
      return result;
    }

    /// Returns the number nearest to 0 of those of one sign, else 0.
    double minmod(const std::initializer_list<double> values)
    {
      const auto [least, most] = std::minmax_element(values.begin(), values.end());
      return *least > 0. ? *least : std::min(*most, 0.);
    }

    /// The limits are those of H. T. Huynh, Accurate monotone cubic interpolation, SIAM J. Numer. Anal. 30 (1993) 57-100, which
    /// let y turn between points. Here y must bend outside of an interval at least half as much as at its ends, and the interval
    /// be at most twice as wide as those beside it: a longer one between equal points is a rest.
    std::vector<double> smooth_slopes(const std::vector<double> &x, const std::vector<double> &y)
    {
      constexpr std::size_t beside = 2;
      const std::size_t n          = x.size();
      const auto width             = [&](const std::size_t i) { return x[i + 1] - x[i]; };
      const auto secant            = [&](const std::size_t i) { return (y[i + 1] - y[i]) / width(i); };
      std::vector<double> bends(n, 0.), result;
      for (std::size_t i = 1; i + 1 < n; ++i)
        bends[i] = (secant(i) - secant(i - 1)) / (x[i + 1] - x[i - 1]);
      const auto change = [&](const std::size_t i)
      {
        const bool is_even = i > 0 && i + 2 < n && width(i) <= 2. * std::min(width(i - 1), width(i + 1));
        return is_even ? minmod({ 2. * bends[i - 1], bends[i], bends[i + 1], 2. * bends[i + 2] }) * width(i) : 0.;
      };
      for (std::size_t i = 0; i < n; ++i)
      {
        const std::size_t left = i == 0 ? 0 : i - 1, right = i + 1 == n ? n - 2 : i;
        const double flat   = 3. * minmod({ secant(left), secant(right) });
        const double turned = 1.5 * minmod({ secant(left) + change(left), secant(right) - change(right) });
        const double at     = polynomial_slope(x, y, i, i < beside ? 0 : i - beside, std::min(n, i + beside + 1));
        result.push_back(std::clamp(at, std::min({ 0., flat, turned }), std::max({ 0., flat, turned })));
      }
      return result;
    }
  } // namespace

  MonotoneCubic::MonotoneCubic(const std::vector<double> &x, const std::vector<double> &y, const Slopes slopes)
  {
    using Smooth = boost::math::interpolators::cubic_hermite<std::vector<double>>;
    using Pchip  = boost::math::interpolators::pchip<std::vector<double>>;
    using Values = std::vector<double>;
    check_points(x, y);
    first          = x.front();
    last           = x.back();
    const auto use = [this](const auto &cubic)
    {
      value_inside = [cubic](const double at) { return cubic(at); };
      slope_inside = [cubic](const double at) { return cubic.prime(at); };
    };
    if (slopes == Slopes::smooth)
      use(Smooth(Values(x), Values(y), smooth_slopes(x, y)));
    else
      use(Pchip(Values(x), Values(y)));
  }

  double MonotoneCubic::value(const double x) const
  {
    return value_inside(std::clamp(x, first, last));
  }

  double MonotoneCubic::derivative(const double x) const
  {
    return x < first || x > last ? 0. : slope_inside(x);
  }
} // namespace sprag
