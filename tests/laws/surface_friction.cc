// SPDX-License-Identifier: GPL-3.0-only
#include "friction_of_point.h"

#include "laws/friction_law.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

using namespace sprag;
using namespace sprag::test;

// Friction of a point on a surface, which slips two ways.

namespace
{
  using One     = dealii::Tensor<1, 1>;
  using Two     = dealii::Tensor<1, 2>;
  using History = FrictionHistory<2>;

  constexpr double stiffness = 1000.;
  constexpr double dt        = 5e-5;
  constexpr double pressure  = 20.;

  const FrictionLaw coulomb = { CoulombFriction{ 0.73 }, FrictionSpeed::sliding };
  const FrictionLaw cork    = { CorkOnAluminium{}, FrictionSpeed::sliding };
  const FrictionLaw creeping{ CorkOnAluminium{}, FrictionSpeed::sliding, 20. };

  Two along(const double angle, const double size)
  {
    return Two({ size * std::cos(angle), size * std::sin(angle) });
  }

  // Central differences over h err by h^2 times third derivatives, which turn and curve over the slip of some 5e-3 mm, and by
  // round-off over h.
  template <class Function>
  dealii::Tensor<2, 2> differences(const Function &function, const Two &at, const double h)
  {
    dealii::Tensor<2, 2> result;
    for (unsigned int j = 0; j < 2; ++j)
    {
      Two change;
      change[j]            = h;
      const Two difference = function(at + change) - function(at - change);
      for (unsigned int i = 0; i < 2; ++i)
        result[i][j] = difference[i] / (2. * h);
    }
    return result;
  }
} // namespace

TEST(SurfaceFriction, StraightSlipInAnyDirectionIsThatOfOneSlip)
{
  struct Step
  {
    double slip, pressure;
  };
  // Sticks, slips, slips back, opens and slips again.
  const Step steps[] = {
    { 1e-3, 20. }, { 8e-3, 18. }, { 5.7e-3, 22. }, { -2e-2, 20. }, { -6e-3, 9. }, { 1e-3, 0. }, { 3e-2, 8. }
  };
  for (const auto &law : { coulomb, cork, creeping })
    for (const double angle : { 0., 0.4, 2., 3.9, 5.5 })
    {
      const Two d = along(angle, 1.);
      History history;
      FrictionHistory<1> plane_history;
      for (const auto &step : steps)
      {
        const auto friction = end_friction(history, stiffness, step.slip * d, step.pressure, law, dt);
        const auto one      = end_friction(plane_history, stiffness, One({ step.slip }), step.pressure, law, dt);
        EXPECT_NEAR((friction.traction - one.traction[0] * d).norm(), 0., 1e-12) << angle;
        EXPECT_NEAR((friction.slip_speed - one.slip_speed[0] * d).norm(), 0., 1e-10);
        EXPECT_NEAR(d * (friction.d_slip * d), one.d_slip[0][0], 1e-9 * stiffness);
        EXPECT_NEAR((friction.d_pressure - one.d_pressure[0] * d).norm(), 0., 1e-13);
        EXPECT_NEAR(friction.mu, one.mu, 1e-13);
        EXPECT_NEAR(friction.energy, one.energy, 1e-14);
        EXPECT_NEAR(friction.dissipated, one.dissipated, 1e-14);
        EXPECT_NEAR(friction.creep, one.creep, 1e-16);
        EXPECT_EQ(friction.slipping, one.slipping);
        history       = { friction.traction, friction.slip_speed, dt };
        plane_history = { one.traction, one.slip_speed, dt };
      }
    }
}

TEST(SurfaceFriction, TurnsWithTheSlipOnTheConeAndDissipates)
{
  for (const auto &law : { coulomb, cork, creeping })
  {
    History history;
    double dissipated = 0.;
    // Half a turn after sliding has begun, 110 mm/s.
    for (unsigned int i = 0; i < 200; ++i)
    {
      const double angle  = 1. + std::max(0., i - 50.) * M_PI / 150.;
      const auto friction = end_friction(history, stiffness, along(angle, 5.5e-3), pressure, law, dt);
      EXPECT_LE(friction.traction.norm(), friction.mu * pressure * (1. + 1e-13)) << i;
      EXPECT_GE(friction.dissipated, -1e-16) << i;
      dissipated += friction.dissipated;
      if (i > 20)
      {
        // The cone is that of 110 mm/s but for the spring's give, and friction lags behind the slip by its length over that of a
        // step, a few steps.
        EXPECT_TRUE(friction.slipping);
        EXPECT_NEAR(friction.traction.norm(), friction_coefficient(law, 110.).coefficient * pressure, 0.02 * pressure) << i;
        EXPECT_GT(friction.traction * along(angle, 1.), std::cos(5. * M_PI / 150.) * friction.traction.norm()) << i;
      }
      history = { friction.traction, friction.slip_speed, dt };
    }
    EXPECT_NEAR(dissipated, friction_coefficient(law, 110.).coefficient * pressure * 200. * 5.5e-3,
                0.03 * 200. * 5.5e-3 * pressure);
  }
}

TEST(SurfaceFriction, ShiftCountsAsFarAsItGoesAlongTheTraction)
{
  const Two trial({ 0.3, 0.4 });
  for (const Two &shift : { Two({ -3e-4, 1e-4 }), Two({ 2e-4, 3e-4 }), Two({ -4e-5, 3e-5 }) })
  {
    const auto at    = [&](const Two &t, const Two &s) { return friction_traction(t, 0.5, cork, 500., 1e-4, s); };
    const auto exact = at(trial, shift);
    ASSERT_TRUE(exact.slipping);
    EXPECT_NEAR(exact.traction[0] * trial[1], exact.traction[1] * trial[0], 1e-16);
    const auto size = friction_traction(One({ 0.5 }), 0.5, cork, 500., 1e-4, One({ shift * trial / 0.5 }));
    EXPECT_NEAR(exact.traction.norm(), size.traction[0], 1e-15);
    EXPECT_NEAR((exact.d_trial - differences([&](const Two &t) { return at(t, shift).traction; }, trial, 1e-6)).norm(), 0., 1e-8);
    EXPECT_NEAR((exact.d_shift - differences([&](const Two &s) { return at(trial, s).traction; }, shift, 1e-8)).norm(), 0., 1e-4);
  }
}
