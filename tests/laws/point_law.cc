// SPDX-License-Identifier: GPL-3.0-only
#include "friction_of_point.h"

#include "laws/friction_law.h"

#include <cmath>
#include <gtest/gtest.h>

using namespace sprag;

namespace
{
  const FrictionLaw coulomb = { CoulombFriction{ 0.73 }, FrictionSpeed::sliding };
  const FrictionLaw cork    = { CorkOnAluminium{}, FrictionSpeed::sliding };
  const FrictionLaw table   = { TabulatedFriction({ 0., 20., 60., 120., 400. }, { 0.3, 0.35, 0.5, 0.85, 0.9 }),
                                FrictionSpeed::sliding };

  struct ConeReturn
  {
    double traction, d_trial, d_pressure, mu;
    bool slipping;
    double d_shift;
  };

  /// Friction of a point with one slip, in numbers.
  ConeReturn friction_traction(const double trial, const double pressure, const FrictionLaw &law, const double penalty,
                               const double dt, const double shift = 0.)
  {
    using One           = dealii::Tensor<1, 1>;
    const auto friction = test::friction_traction(One({ trial }), pressure, law, penalty, dt, One({ shift }));
    return { friction.traction[0], friction.d_trial[0][0], friction.d_pressure[0],
             friction.mu,          friction.slipping,      friction.d_shift[0][0] };
  }

  /// Trial traction whose slip speed is `speed`: the inverse of the return mapping.
  double compute_trial(const double speed, const double pressure, const FrictionLaw &law, const double penalty, const double dt)
  {
    return friction_coefficient(law, speed).coefficient * pressure + penalty * dt * speed;
  }

  // |t| - mu(w) p and w = (|trial| - |t|) / (eps dt) hold together to the round-off of |trial|, which mu(w) sees times
  // 1 + |mu'| p / (eps dt).
  void expect_on_cone(const double trial, const double pressure, const FrictionLaw &law, const double penalty, const double dt)
  {
    const auto friction = friction_traction(trial, pressure, law, penalty, dt);
    const double speed  = (std::abs(trial) - std::abs(friction.traction)) / (penalty * dt);
    const auto mu       = friction_coefficient(law, speed);
    const double size   = std::abs(trial) * (1. + std::abs(mu.derivative) * pressure / (penalty * dt));
    EXPECT_TRUE(friction.slipping);
    EXPECT_EQ(std::signbit(friction.traction), std::signbit(trial));
    EXPECT_NEAR(std::abs(friction.traction), mu.coefficient * pressure, 1e-14 * size) << "trial " << trial << ", p " << pressure;
    EXPECT_NEAR(friction.mu, mu.coefficient, 1e-14 * size / pressure);
  }
} // namespace

TEST(FrictionTraction, ShiftLeadsToMuAtAnotherSpeedThanTheMean)
{
  const double penalty = 80., dt = 0.01, pressure = 0.2, speed = 100.;
  for (const auto &law : { coulomb, cork })
    for (const double sense : { 1., -1. })
      for (const double shift : { -0.3, -0.01, 0.02, 0.3 })
      {
        const double mu    = friction_coefficient(law, speed).coefficient;
        const double trial = mu * pressure + penalty * (dt * speed - shift);
        const auto at      = [&](const double more)
        { return friction_traction(sense * trial, pressure, law, penalty, dt, sense * shift + more); };
        EXPECT_TRUE(at(0.).slipping);
        EXPECT_NEAR(at(0.).traction, sense * mu * pressure, 1e-12);
        EXPECT_NEAR(at(0.).mu, mu, 1e-12);
        EXPECT_NEAR(at(0.).d_shift, (at(1e-5).traction - at(-1e-5).traction) / 2e-5, 1e-6);
      }
}

TEST(FrictionTraction, ShiftNeitherPullsBackNorBeyondTheTrial)
{
  const double penalty = 80., dt = 0.01, pressure = 0.2;
  const double at_rest = 0.3491 * pressure;
  const double trial   = 1.1 * at_rest;
  EXPECT_DOUBLE_EQ(friction_traction(trial, pressure, cork, penalty, dt, -1.).traction, at_rest);
  EXPECT_DOUBLE_EQ(friction_traction(trial, pressure, cork, penalty, dt, 1.).traction, trial);
  EXPECT_FALSE(friction_traction(trial, pressure, cork, penalty, dt, 1.).slipping);
  // In stick it does not count.
  EXPECT_DOUBLE_EQ(friction_traction(0.9 * at_rest, pressure, cork, penalty, dt, 1.).traction, 0.9 * at_rest);
}

TEST(FrictionTraction, StickKeepsTheTrialUpToTheConeAtRest)
{
  for (const auto &law : { coulomb, cork, table })
  {
    const double limit = friction_coefficient(law, 0.).coefficient * 2.;
    for (const double trial : { 0., 0.3, limit * (1. - 1e-12), -limit * (1. - 1e-12) })
    {
      const auto friction = friction_traction(trial, 2., law, 500., 0.01);
      EXPECT_FALSE(friction.slipping);
      EXPECT_EQ(friction.traction, trial);
      EXPECT_EQ(friction.d_trial, 1.);
      EXPECT_EQ(friction.d_pressure, 0.);
      EXPECT_EQ(friction.mu, friction_coefficient(law, 0.).coefficient);
    }
  }
}

TEST(FrictionTraction, SlipSpeedAndCoefficientAreSolvedTogether)
{
  for (const auto &law : { coulomb, cork, table })
    for (const double dt : { 1e-5, 1e-3, 1e-2, 1. })
      for (const double pressure : { 1e-3, 0.5, 4. })
        for (const double speed : { 1e-3, 1., 50., 112., 199.9, 250., 749., 2000. })
        {
          const double trial = compute_trial(speed, pressure, law, 500., dt);
          expect_on_cone(trial, pressure, law, 500., dt);
          expect_on_cone(-trial, pressure, law, 500., dt);
        }
}
