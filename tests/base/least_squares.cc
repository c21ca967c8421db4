// SPDX-License-Identifier: GPL-3.0-only
#include "base/least_squares.h"

#include <cmath>
#include <gtest/gtest.h>

using namespace sprag;

// The line through y = 0, 0, 3 at x = 0, 1, 2 has by hand the slope 3/2 and is -1/2 at 0.
TEST(LeastSquares, LineOfPointsOffAnyLine)
{
  const auto line = fitted_line({ 0., 1., 2. }, { 0., 0., 3. });
  EXPECT_NEAR(line.slope, 1.5, 1e-14);
  EXPECT_NEAR(line.at(0.), -0.5, 1e-14);
}

TEST(LeastSquares, AWeightIsAsManyPoints)
{
  const auto weighted = fitted_line({ 0., 1., 2. }, { 0., 0., 3. }, { 1., 1., 3. });
  const auto repeated = fitted_line({ 0., 1., 2., 2., 2. }, { 0., 0., 3., 3., 3. });
  EXPECT_NEAR(weighted.slope, repeated.slope, 1e-14);
  EXPECT_NEAR(weighted.at(0.), repeated.at(0.), 1e-14);
}

TEST(LeastSquares, SlopeOfAParabolaAtTheOrigin)
{
  std::vector<double> x, y;
  for (int i = 1; i <= 10; ++i)
  {
    x.push_back(i);
    y.push_back(0.7 * i - 0.02 * i * i);
  }
  EXPECT_NEAR(slope_at_origin(x, y), 0.7, 1e-12);
}

// (1 - a)^2 + (3 - a)^2 is least at a = 2, where both are off by 1, a third of the largest.
TEST(LeastSquares, FactorOfAShape)
{
  const auto fit = fitted_factor({ 1., 1. }, { 1., 3. });
  EXPECT_NEAR(fit.factor, 2., 1e-14);
  EXPECT_NEAR(fit.error, 1. / 3., 1e-14);
}
