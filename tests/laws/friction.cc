// SPDX-License-Identifier: GPL-3.0-only
#include "laws/friction_law.h"

#include "base/errors.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

using namespace sprag;

namespace
{
  FrictionLaw make_law(decltype(FrictionLaw::law) choice)
  {
    return { std::move(choice), FrictionSpeed::sliding };
  }

  void expect_derivative(const FrictionLaw &law, const double speed)
  {
    // Central differences of a cubic with third derivative below 1e-6 err by less than h^2 1e-6 plus round-off 1e-16/h.
    const double h          = 1e-3;
    const double difference = friction_coefficient(law, speed + h).coefficient - friction_coefficient(law, speed - h).coefficient;
    EXPECT_NEAR(friction_coefficient(law, speed).derivative, difference / (2. * h), 1e-11) << "speed " << speed;
  }

  const TabulatedFriction measured({ 10., 100., 200., 400., 800. }, { 0.3, 0.7, 0.7, 0.9, 1.0 });
} // namespace

TEST(Friction, CorkOnAluminiumHasThePapersValues)
{
  const auto law = make_law(CorkOnAluminium{});
  EXPECT_DOUBLE_EQ(friction_coefficient(law, 0.).coefficient, 0.3491);
  EXPECT_NEAR(friction_coefficient(law, 112.).coefficient, 0.72852016, 1e-12);
  EXPECT_NEAR(friction_coefficient(law, 200.).coefficient, -7.086e-7 * 4e4 + 1.058e-3 * 200. + 0.6809, 1e-12);
  EXPECT_EQ(friction_coefficient(law, 750.).coefficient, 1.076);
  EXPECT_EQ(friction_coefficient(law, 5000.).coefficient, 1.076);
}

TEST(Friction, StribeckFallsFromRestAndGrowsAgainWithSpeed)
{
  const auto law = make_law(StribeckFriction{ 0.9, 0.6, 30., 2., 1e-3 });
  EXPECT_DOUBLE_EQ(friction_coefficient(law, 0.).coefficient, 0.9);
  EXPECT_DOUBLE_EQ(friction_coefficient(law, 0.).derivative, 1e-3);
  EXPECT_DOUBLE_EQ(friction_coefficient(law, 30.).coefficient, 0.6 + 0.3 / std::exp(1.) + 0.03);
  EXPECT_DOUBLE_EQ(friction_coefficient(law, 1e4).coefficient, 0.6 + 10.);
  EXPECT_DOUBLE_EQ(friction_coefficient(make_law(StribeckFriction{ 0.9, 0.6, 30., 1., 0. }), 0.).derivative, -0.01);
}

TEST(Friction, FallsWhereAnySpeedHasASmallerCoefficient)
{
  for (const auto &law :
       { make_law(CoulombFriction{}), make_law(CorkOnAluminium{}), make_law(StribeckFriction{ 0.4, 0.7, 50., 2. }),
         make_law(StribeckFriction{ 0.9, 0.6, 30., 1., 1.01e-2 }),
         make_law(TabulatedFriction({ 0., 20., 60., 120. }, { 0.3, 0.35, 0.345, 0.85 })) })
    EXPECT_FALSE(falls_with_speed(law));
  for (const auto &law : { make_law(StribeckFriction{ 0.9, 0.6, 30., 1., 0.99e-2 }),
                           make_law(TabulatedFriction({ 0., 20., 60., 120. }, { 0.3, 0.35, 0.34, 0.36 })) })
    EXPECT_TRUE(falls_with_speed(law));
}

TEST(Friction, DerivativesAgreeWithFiniteDifferences)
{
  // Differences of an exponential over 30 mm/s err by h^2/6 times a third derivative below 3e-4, and by round-off 1e-16/h.
  for (const double exponent : { 1., 1.5, 2., 4. })
    for (const double speed : { 2., 10., 30., 60., 300. })
    {
      const auto law = make_law(StribeckFriction{ 0.9, 0.6, 30., exponent, 1e-3 });
      const double h = 1e-3;
      const auto mu  = [&](const double v) { return friction_coefficient(law, v).coefficient; };
      EXPECT_NEAR(friction_coefficient(law, speed).derivative, (mu(speed + h) - mu(speed - h)) / (2. * h), 1e-10) << speed;
    }
  for (const double speed : { 1., 112., 199., 201., 500., 749., 751. })
    expect_derivative(make_law(CorkOnAluminium{}), speed);
  for (const double speed : { 5., 11., 60., 150., 250., 399., 700., 900. })
    expect_derivative(make_law(measured), speed);
}

TEST(Friction, PiecesOfALawThatRisesAreTheLaw)
{
  for (auto law : { make_law(CorkOnAluminium{}), make_law(CoulombFriction{ 0.4 }) })
  {
    law.factor        = 1.3;
    const auto pieces = rising_pieces(law);
    ASSERT_FALSE(pieces.empty());
    EXPECT_EQ(pieces.front().from, 0.);
    for (const double speed : { 0., 1., 199.9, 200., 500., 749.9, 750., 2000. })
    {
      const auto beyond   = std::find_if(pieces.begin(), pieces.end(), [&](const auto &piece) { return piece.from > speed; });
      const auto &piece   = *(beyond - 1);
      const auto expected = friction_coefficient(law, speed);
      EXPECT_DOUBLE_EQ((piece.quadratic * speed + piece.linear) * speed + piece.constant, expected.coefficient);
      EXPECT_NEAR(2. * piece.quadratic * speed + piece.linear, expected.derivative, 1e-17);
    }
  }
  EXPECT_TRUE(rising_pieces(make_law(StribeckFriction{})).empty());
  EXPECT_TRUE(rising_pieces(make_law(measured)).empty());
}

TEST(Friction, TableMeetsItsRowsAndIsConstantBeyondThem)
{
  const auto law = make_law(measured);
  EXPECT_DOUBLE_EQ(friction_coefficient(law, 100.).coefficient, 0.7);
  EXPECT_DOUBLE_EQ(friction_coefficient(law, 800.).coefficient, 1.0);
  EXPECT_DOUBLE_EQ(friction_coefficient(law, 0.).coefficient, 0.3);
  EXPECT_EQ(friction_coefficient(law, 0.).derivative, 0.);
  EXPECT_DOUBLE_EQ(friction_coefficient(law, 1e4).coefficient, 1.0);
  EXPECT_EQ(friction_coefficient(law, 1e4).derivative, 0.);
}

TEST(Friction, TableNeverOvershootsItsRows)
{
  const auto law = make_law(measured);
  double before  = 0.;
  for (double speed = 0.; speed <= 900.; speed += 0.5)
  {
    const double mu = friction_coefficient(law, speed).coefficient;
    EXPECT_GE(mu, before - 1e-14);
    EXPECT_LE(mu, 1.0 + 1e-14);
    before = mu;
  }
}

TEST(Friction, TableThatIsNoneIsRefused)
{
  EXPECT_THROW(TabulatedFriction({ 0., 1., 2. }, { 1., 1., 1. }), InputError);
  EXPECT_THROW(TabulatedFriction({ 0., 1., 2., 3. }, { 1., 1., 1. }), InputError);
  EXPECT_THROW(TabulatedFriction({ 0., 1., 1., 3. }, { 1., 1., 1., 1. }), InputError);
  EXPECT_THROW(TabulatedFriction({ -1., 1., 2., 3. }, { 1., 1., 1., 1. }), InputError);
  EXPECT_THROW(TabulatedFriction({ 0., 1., 2., 3. }, { 1., -0.1, 1., 1. }), InputError);
  EXPECT_THROW(TabulatedFriction({ 0., 1., 2., 3. }, { 1., std::nan(""), 1., 1. }), InputError);
}
