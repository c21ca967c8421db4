// SPDX-License-Identifier: GPL-3.0-only
#include "base/local_regression.h"

#include <cmath>
#include <gtest/gtest.h>

using namespace sprag;

// A parabola fits itself, and what is level stays so bit for bit, whatever the rows' distances.
TEST(LocalRegression, KeepsParabolasAndRests)
{
  std::vector<double> x, y, level;
  for (unsigned int i = 0; i < 60; ++i)
  {
    x.push_back(0.1 * i + 0.03 * (i % 3));
    y.push_back(2. + x.back() * (1. - 0.3 * x.back()));
    level.push_back(i < 30 ? 0.7 : y.back());
  }
  const auto fitted = locally_fitted(x, y, 1.5);
  for (std::size_t i = 0; i < x.size(); ++i)
    EXPECT_NEAR(fitted[i], y[i], 1e-8);
  const auto rest = locally_fitted(x, level, 1.5);
  for (std::size_t i = 0; i < 22; ++i)
    EXPECT_EQ(rest[i], 0.7);
  for (const double narrow : { 0.2, 1e-17 })
    EXPECT_EQ(locally_fitted(x, y, narrow), y) << "too few rows";
}

// The shares are those of the weights' transfer function: cosines fitted by another program, numpy.
TEST(LocalRegression, PassesWavesByTheirLength)
{
  constexpr double width = 1.;
  for (const auto &[waves, share] : { std::pair(0.5, 0.9932), { 1., 0.9089 }, { 2., 0.2914 } })
  {
    std::vector<double> x, y;
    for (unsigned int i = 0; i <= 2000; ++i)
    {
      x.push_back(0.005 * i);
      y.push_back(std::cos(2. * M_PI * waves / width * x.back()));
    }
    EXPECT_NEAR(locally_fitted(x, y, width)[1000] / y[1000], share, 1e-3);
  }
}
