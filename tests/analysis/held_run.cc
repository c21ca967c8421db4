// SPDX-License-Identifier: GPL-3.0-only
#include "analysis/transient/held_run.h"

#include <cmath>
#include <gtest/gtest.h>

using namespace sprag;

namespace
{
  HeldSlide slide_at(const double x, const double speed)
  {
    HeldSlide slide;
    slide.drive = { 0., x, -112., 0. };
    slide.speed = speed;
    return slide;
  }
} // namespace

TEST(HeldPath, TurnsTheSurfaceAtTheSpeedOfTheSlide)
{
  const auto at = held_path({ 0.5, 65., 0., 0., -3. }, slide_at(65., -108.))(0.6);
  EXPECT_EQ(at.x, 65.);
  EXPECT_EQ(at.v, 0.);
  EXPECT_NEAR(at.surface, -3. - 10.8, 1e-12);
}

TEST(MovingPath, HasTheRatesOfItsMotionAndEndsAtRest)
{
  const auto begin = slide_at(65., -108.), end = slide_at(60., -109.);
  const auto path    = moving_path({ 1., 65., 0., 0., -7. }, begin, end, 0.1);
  constexpr double h = 1e-5;
  // Central differences err by h^2 / 6 of the third derivatives, 60 dx / T^3 and its rate 360 dx / T^4.
  for (const double time : { 1.01, 1.04, 1.05, 1.08 })
  {
    EXPECT_NEAR((path(time + h).x - path(time - h).x) / (2. * h), path(time).v, h * h / 6. * 60. * 5. / 1e-3 + 1e-8);
    EXPECT_NEAR((path(time + h).v - path(time - h).v) / (2. * h), path(time).a, h * h / 6. * 360. * 5. / 1e-4 + 1e-6);
  }
  EXPECT_NEAR(path(1.).x, 65., 1e-12);
  EXPECT_NEAR(path(1.).surface, -7., 1e-12);
  EXPECT_NEAR(path(1.1).x, 60., 1e-12);
  EXPECT_NEAR(path(1.1).v, 0., 1e-9);
  EXPECT_NEAR(path(1.15).x, 60., 1e-12);
}

// Slip by the surface and by the motion of the centre, speed / v of a mm of x, add up to the speed of the slides.
TEST(MovingPath, KeepsTheSlipGoing)
{
  const auto begin = slide_at(65., -108.), end = slide_at(60., -109.);
  for (const bool there : { true, false })
  {
    const auto &a = there ? begin : end, &b = there ? end : begin;
    const auto path    = moving_path({ 0., a.drive.x, 0., 0., 0. }, a, b, 0.1);
    constexpr double h = 1e-5;
    for (const double time : { 0.01, 0.05, 0.08, 0.12 })
    {
      const auto at        = path(time);
      const double turning = (path(time + h).surface - path(time - h).surface) / (2. * h);
      const double share   = (at.x - 65.) / (60. - 65.);
      const double ratio   = (-108. + share * (-109. + 108.)) / -112.;
      // The ratio is a line in x, as is the speed: differences are left to h^2.
      EXPECT_NEAR(turning + ratio * at.v, -108. - share, 1e-4) << time;
    }
  }
}
