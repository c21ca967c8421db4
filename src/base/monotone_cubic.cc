// SPDX-License-Identifier: GPL-3.0-only
#include "base/monotone_cubic.h"

#include "base/errors.h"
#include "base/text.h"

#include <algorithm>
#include <cmath>
#include <functional>

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

    std::vector<double> smooth_slopes(const std::vector<double> &x, const std::vector<double> &y)
    {
      constexpr std::size_t beside = 2;
      const std::size_t n          = x.size();
      const auto secant            = [&](const std::size_t i) { return (y[i + 1] - y[i]) / (x[i + 1] - x[i]); };
      std::vector<double> result;
      for (std::size_t i = 0; i < n; ++i)
      {
        const double before = secant(i == 0 ? 0 : i - 1), after = secant(i + 1 == n ? n - 2 : i);
        const double sign = before * after > 0. ? std::copysign(1., after) : 0.;
        const double most = 3. * std::min(std::abs(before), std::abs(after));
        const double at   = polynomial_slope(x, y, i, i < beside ? 0 : i - beside, std::min(n, i + beside + 1));
        result.push_back(sign * std::clamp(sign * at, 0., most));
      }
      return result;
    }
  } // namespace

  struct MonotoneCubic::Interpolant
  {
    std::function<double(double)> value, slope;

    template <class Cubic>
    explicit Interpolant(const std::shared_ptr<const Cubic> &cubic)
        : value([cubic](const double x) { return (*cubic)(x); })
        , slope([cubic](const double x) { return cubic->prime(x); })
    {
    }
  };

  MonotoneCubic::MonotoneCubic(const std::vector<double> &x, const std::vector<double> &y, const Slopes slopes)
  {
    using Smooth = boost::math::interpolators::cubic_hermite<std::vector<double>>;
    using Pchip  = boost::math::interpolators::pchip<std::vector<double>>;
    using Values = std::vector<double>;
    check_points(x, y);
    first = x.front();
    last  = x.back();
    if (slopes == Slopes::smooth)
      interpolant = std::make_shared<Interpolant>(std::make_shared<const Smooth>(Values(x), Values(y), smooth_slopes(x, y)));
    else
      interpolant = std::make_shared<Interpolant>(std::make_shared<const Pchip>(Values(x), Values(y)));
  }

  double MonotoneCubic::value(const double x) const
  {
    return interpolant->value(std::clamp(x, first, last));
  }

  double MonotoneCubic::derivative(const double x) const
  {
    return x < first || x > last ? 0. : interpolant->slope(x);
  }
} // namespace sprag
