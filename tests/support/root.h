// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include <functional>
#include <gtest/gtest.h>

namespace sprag
{
  /// Returns the root of a function between two places, by bisection.
  inline double root(const std::function<double(double)> &f, double low, double high)
  {
    const bool rising = f(high) > 0.;
    EXPECT_NE(f(low) > 0., rising) << "no root between " << low << " and " << high;
    for (unsigned int i = 0; i < 200; ++i)
    {
      const double middle                       = 0.5 * (low + high);
      ((f(middle) > 0.) == rising ? high : low) = middle;
    }
    return low;
  }
} // namespace sprag
