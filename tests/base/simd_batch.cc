// SPDX-License-Identifier: GPL-3.0-only
#include "base/simd_batch.h"

#include <gtest/gtest.h>

using namespace sprag;

TEST(SimdBatch, AnglesAreThoseOfTheLibrary)
{
  const double angles[n_lanes] = { 0., 1e-9, -1e-4, 0.0299, -0.0301, 1.2, -2., 3.1 };
  SimdBatch x_0{}, y_0{}, x_1{}, y_1{};
  for (unsigned int i = 0; i < n_lanes; ++i)
  {
    const double from = 0.3 * i, radius = 2. + i;
    x_0[i] = std::cos(from);
    y_0[i] = std::sin(from);
    x_1[i] = radius * std::cos(from + angles[i]);
    y_1[i] = radius * std::sin(from + angles[i]);
  }
  const SimdBatch found = angle_between(x_0, y_0, x_1, y_1);
  for (unsigned int i = 0; i < n_lanes; ++i)
    EXPECT_NEAR(found[i], angles[i], 4e-16 * (1. + 4. * std::abs(angles[i]))); // round-off of the places
}

TEST(SimdBatch, ChoosesAndReducesLaneByLane)
{
  SimdBatch value{};
  for (unsigned int i = 0; i < n_lanes; ++i)
    value[i] = i % 2 == 0 ? -1. * i : 1. * i;
  const SimdBatch root = square_root(absolute(value));
  for (unsigned int i = 0; i < n_lanes; ++i)
    EXPECT_EQ(root[i], std::sqrt(static_cast<double>(i)));
  EXPECT_EQ(largest(value), 7.);
  EXPECT_EQ(sum(value), 1. - 2. + 3. - 4. + 5. - 6. + 7.);
  EXPECT_TRUE(any(value > 6.5));
  EXPECT_FALSE(any(value > 7.5));
  EXPECT_EQ(smaller(value, uniform_batch(0.))[5], 0.);
  EXPECT_EQ(larger(value, uniform_batch(0.))[5], 5.);
}
