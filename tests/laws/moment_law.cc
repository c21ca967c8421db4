// SPDX-License-Identifier: GPL-3.0-only
#include "laws/moment_law.h"

#include "support/hardening.h"

#include <cmath>
#include <gtest/gtest.h>

using namespace sprag;

namespace
{
  constexpr double k = 7.4e4;
  constexpr double c = 3e6;

  MomentLaw hardening()
  {
    return cubic_hardening(k, c, -4, 6);
  }
} // namespace

TEST(MomentLaw, IsLinearWithoutSamples)
{
  const MomentLaw law(k);
  EXPECT_TRUE(law.is_linear());
  EXPECT_EQ(law.moment(0.03), k * 0.03);
  EXPECT_EQ(law.stiffness(0.03), k);
  EXPECT_EQ(law.energy(0.03), 0.5 * k * 0.03 * 0.03);
  EXPECT_EQ(law.excess(0.03), 0.);
}

TEST(MomentLaw, AtRestAtATurnIsTheSameSpringShifted)
{
  constexpr double rest = -0.012;
  for (const MomentLaw &law : { MomentLaw(k), hardening() })
  {
    const auto preloaded = law.at_rest_at(rest);
    EXPECT_FALSE(preloaded.is_linear());
    EXPECT_EQ(preloaded.linear_stiffness(), k);
    for (const double turn : { -0.0371, 0., 0.0049, 0.0333, 0.09 })
    {
      EXPECT_NEAR(preloaded.moment(turn), law.moment(turn - rest), 1e-11 * k);
      EXPECT_NEAR(preloaded.stiffness(turn), law.stiffness(turn - rest), 1e-11 * k);
      EXPECT_NEAR(preloaded.energy(turn), law.energy(turn - rest), 1e-13 * k);
    }
  }
}

TEST(MomentLaw, MeetsACubicSpringBetweenItsSamples)
{
  const auto law = hardening();
  for (const double turn : { -0.0371, -0.01, 0., 0.0049, 0.0333, 0.06 })
  {
    EXPECT_NEAR(law.moment(turn), k * turn + c * std::pow(turn, 3), 1e-11 * k);
    EXPECT_NEAR(law.stiffness(turn), k + 3. * c * turn * turn, 1e-11 * k);
    EXPECT_NEAR(law.energy(turn), 0.5 * k * turn * turn + 0.25 * c * std::pow(turn, 4), 1e-13 * k);
  }
}

TEST(MomentLaw, GoesOnAlongItsTangents)
{
  const auto law = hardening();
  for (const auto &[end, beyond] : { std::pair<double, double>{ 0.06, 0.1 }, { -0.04, -0.07 } })
  {
    const double slope = k + 3. * c * end * end;
    const double more  = beyond - end;
    EXPECT_NEAR(law.stiffness(beyond), slope, 1e-10 * slope);
    EXPECT_NEAR(law.moment(beyond), law.moment(end) + slope * more, 1e-10 * k);
    EXPECT_NEAR(law.energy(beyond), law.energy(end) + more * (law.moment(end) + 0.5 * slope * more), 1e-12 * k);
  }
}
