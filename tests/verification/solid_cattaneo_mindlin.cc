// SPDX-License-Identifier: GPL-3.0-only
#include "mpi_environment.h"
#include "verification/hertz_ball.h"

using namespace sprag;

namespace
{
  using Vector = RubbedBlock::Vector;

  // Kalker's example (Three-dimensional elastic bodies in rolling contact, 1990, 5.2.1.1): two equal balls of 100 mm, which by
  // 0.02 mm press on a circle of 1 mm.
  constexpr double R = 50., shear_modulus = 200., coefficient = 0.4, depth = 0.02;

  std::vector<double> half_face(const double cell)
  {
    return graded_parts(cell, 1.25, 1.7, 20.);
  }

  SolidBlock block(const std::vector<double> &xi, const std::vector<double> &zeta, const double poisson_ratio)
  {
    return { { xi, graded_parts(0.25, 0.5, 1.9, 20.), zeta }, { 2. * shear_modulus * (1. + poisson_ratio), poisson_ratio } };
  }

  /// Numbers over those of the closed form, where Q is so much of mu P.
  struct Deviation
  {
    double load; ///< Q / (mu P)
    double stick, shift;
    double across; ///< largest friction across the load over mu p0
  };

  /// Pressed without friction, then pushed along the face so far, over the way at which all of it slides.
  ///   c = a (1 - Q / (mu P))^(1/3),  shift = 3 mu P / (16 a) sum (2 - nu) / G [1 - (c/a)^2]
  Deviation pushed(const SolidBlock &solid, const NearFace &near, const double poisson_ratio, const double penalty,
                   const Vector &direction, const double share)
  {
    RubbedBlock rubbed(solid, near, { R, R, penalty });
    for (const double part : { 0.3, 1. })
      rubbed.move(Vector({ 0., -part * depth, 0. }), 0.);
    const auto ball   = hertz_ball(rubbed.force()[1], R, shear_modulus / (1. - poisson_ratio));
    const double full = 3. / 8. * coefficient * rubbed.force()[1] / ball.a * (2. - poisson_ratio) / shear_modulus;
    for (const double part : { 0.5, 1. })
      rubbed.move(Vector({ 0., -depth, 0. }) - part * share * full * direction, coefficient);

    Deviation result{ rubbed.force() * direction / (coefficient * rubbed.force()[1]), 0., 0., 0. };
    const double c = ball.a * std::cbrt(1. - result.load);
    for (const auto &point : rubbed.points())
    {
      result.stick += point.slipping ? 0. : point.area;
      const double across = point.friction[0] * direction[2] - point.friction[1] * direction[0];
      result.across       = std::max(result.across, std::abs(across) / (coefficient * ball.p0));
    }
    result.stick = std::sqrt(result.stick / M_PI) / c;

    // Friction moves a half-space's surface along itself as pressure moves it along its normal, but for a factor of the direction
    // (Cerruti), which for nu > 0 is exact at some distance.
    const HertzPressure slip{ ball.a, coefficient * ball.p0, 2. * shear_modulus };
    const HertzPressure stick{ c, coefficient * ball.p0 * c / ball.a, 2. * shear_modulus };
    const auto by_friction = [&](const Vector &place)
    {
      const double r = place.norm(), along = place * direction / r;
      return (1. - poisson_ratio + poisson_ratio * along * along) * (slip.displacement(r) - stick.displacement(r));
    };
    const double ends = 2. * missing(rubbed, by_friction, direction, 5. * ball.a);
    result.shift      = (share * full + ends) / (full * (1. - c * c / (ball.a * ball.a)));
    return result;
  }

  void expect_closed_form(const SolidBlock &solid, const double poisson_ratio, const Vector &direction,
                          const double stick_tolerance, const double shift_tolerance, const double largest_across,
                          const std::vector<double> &shares = { 0.3, 0.75 })
  {
    const auto near = with_mirror_image(near_face(solid, 1.8));
    for (const double share : shares)
    {
      Deviation found{};
      std::vector<double> shift;
      for (const double penalty : { 3e3, 1.5e4 })
      {
        found = pushed(solid, near, poisson_ratio, penalty, direction, share);
        shift.push_back(found.shift);
      }
      EXPECT_NEAR(found.stick, 1., stick_tolerance) << "Q / mu P " << found.load;
      EXPECT_NEAR(without_penalty(shift, 5.), 1., shift_tolerance) << "Q / mu P " << found.load;
      EXPECT_LT(found.across, largest_across);
    }
  }
} // namespace

// Equal balls yield alike, so that friction does not change the pressure, and with nu = 0 friction moves points along itself
// alone: there the closed form is exact. The blocks end: their free sides let them yield by 1 to 2 % more than a half-space. The
// stick's edge lies in a cell of 0.3 a (0.25 a in the slow ones), so that its radius is uncertain by some hundredths of a; the
// shift is not.
TEST(SolidCattaneoMindlin, BallsPushedAlongTheFaceSlow)
{
  const auto half = half_face(0.3);
  expect_closed_form(block(mirrored(half), half, 0.), 0., Vector({ 1., 0., 0. }), 0.03, 0.01, 0.06, { 0.75 });
}

TEST(SolidCattaneoMindlin, BallsPushedAcrossTheFaceSlow)
{
  const auto half = half_face(0.25);
  expect_closed_form(block(half, mirrored(half), 0.), 0., Vector({ 0., 0., 1. }), 0.03, 0.01, 0.06);
}

TEST(SolidCattaneoMindlin, BallsPushedAskewSlow)
{
  const auto whole = mirrored(half_face(0.25));
  expect_closed_form(block(whole, whole, 0.), 0., Vector({ 0.6, 0., 0.8 }), 0.03, 0.01, 0.06);
}

// With nu = 0.42 friction moves points across itself as well, and where they slip turns after them, which the closed form leaves
// out.
TEST(SolidCattaneoMindlin, BallsThatContractSlow)
{
  const auto half = half_face(0.25);
  expect_closed_form(block(mirrored(half), half, 0.42), 0.42, Vector({ 1., 0., 0. }), 0.03, 0.01, 0.2);
}
