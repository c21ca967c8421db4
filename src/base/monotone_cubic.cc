// SPDX-License-Identifier: GPL-3.0-only
#include "base/monotone_cubic.h"

#include "base/errors.h"
#include "base/text.h"

#include <algorithm>
#include <cmath>

// Boost 1.74 calls isnan without its namespace, which only this header provides.
#include <math.h>

#include <boost/math/interpolators/pchip.hpp>

namespace sprag
{
  class MonotoneCubic::Interpolant : public boost::math::interpolators::pchip<std::vector<double>>
  {
  public:
    using pchip::pchip;
  };

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
  } // namespace

  MonotoneCubic::MonotoneCubic(const std::vector<double> &x, const std::vector<double> &y)
  {
    check_points(x, y);
    first       = x.front();
    last        = x.back();
    interpolant = std::make_shared<const Interpolant>(std::vector<double>(x), std::vector<double>(y));
  }

  double MonotoneCubic::value(const double x) const
  {
    return (*interpolant)(std::clamp(x, first, last));
  }

  double MonotoneCubic::derivative(const double x) const
  {
    return x < first || x > last ? 0. : interpolant->prime(x);
  }
} // namespace sprag
