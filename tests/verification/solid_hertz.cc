// SPDX-License-Identifier: GPL-3.0-only
#include "mpi_environment.h"
#include "verification/hertz_ball.h"

using namespace sprag;

namespace
{
  /// The contact of a block: force, largest pressure and half axes, from sums over the points in contact.
  struct Pressed
  {
    double P;            ///< [N]
    double largest = 0.; ///< pressure [MPa]
    double xi      = 0.,
           zeta    = 0.; ///< half axes of the ellipse whose mean squares of xi and zeta under Hertz' pressure those are [mm]
  };

  Pressed pressed(const RubbedBlock &rubbed)
  {
    Pressed result{ rubbed.force()[1] };
    for (const auto &point : rubbed.points())
    {
      const double share = point.area * point.pressure / result.P;
      result.xi += share * point.xi * point.xi;
      result.zeta += share * point.zeta * point.zeta;
      result.largest = std::max(result.largest, point.pressure);
    }
    result.xi   = std::sqrt(5. * result.xi);
    result.zeta = std::sqrt(5. * result.zeta);
    return result;
  }

  void press(RubbedBlock &rubbed, const double depth)
  {
    for (const double share : { 0.3, 1. })
      rubbed.move(RubbedBlock::Vector({ 0., -share * depth, 0. }), 0.);
  }
} // namespace

// The penalty is a bed of springs on the face. What it changes falls as 1 / penalty: two of them tell where none is left, which
// here is some 1 to 2 % beyond the stiffer. The block of 24 a ends, so that it takes less to press it than a half-space: by as
// much as its face lacks of the half-space's displacement 5 a away.
TEST(SolidHertz, ABallOnABlock)
{
  constexpr double R = 10., modulus = 1000. / (1. - 0.3 * 0.3), depth = 0.0165;
  const auto parts = graded_parts(0.12, 0.48, 1.6, 10.);
  const SolidBlock block({ parts, graded_parts(0.12, 0.24, 1.6, 10.), parts }, { 1000., 0.3 });
  const auto near = near_face(block, 0.7);
  std::vector<double> radius, pressure, approach;
  for (const double penalty : { 2e4, 1e5 })
  {
    RubbedBlock rubbed(block, near, { R, R, penalty });
    press(rubbed, depth);
    const auto found             = pressed(rubbed);
    const auto ball              = hertz_ball(found.P, R, modulus);
    const auto ball_displacement = [&](const RubbedBlock::Vector &place) { return ball.displacement(place.norm()); };
    EXPECT_NEAR(found.xi, found.zeta, 5e-3 * ball.a); // its points are denser along xi
    radius.push_back(found.xi / ball.a);
    pressure.push_back(found.largest / ball.p0);
    approach.push_back((depth + missing(rubbed, ball_displacement, RubbedBlock::Vector({ 0., 1., 0. }), 5. * ball.a)) /
                       (ball.a * ball.a / R));
  }
  EXPECT_GT(std::abs(radius.back() - 1.), 5e-3); // or the penalty would not matter
  EXPECT_NEAR(without_penalty(radius, 5.), 1., 3e-3);
  EXPECT_NEAR(without_penalty(pressure, 5.), 1., 5e-3);
  EXPECT_NEAR(without_penalty(approach, 5.), 1., 1e-2);
}

// R = 56 and 500 mm on aluminium: under 30 N half axes of 0.167261 and 0.700567 mm and 122.241 MPa by Hertz' elliptic integrals,
// which grow as P^(1/3).
TEST(SolidHertz, ABarrelOnABlockSlow)
{
  const SolidBlock block(
      { graded_parts(0.05, 0.2, 1.7, 10.), graded_parts(0.05, 0.15, 1.7, 14.), graded_parts(0.2, 0.8, 1.7, 14.) },
      { 70000., 0.33 });
  const auto near = near_face(block, 1.2);
  std::vector<double> across, along, pressure;
  for (const double penalty : { 2e6, 1e7 })
  {
    RubbedBlock rubbed(block, near, { 56., 500., penalty });
    press(rubbed, 7.2e-4);
    const auto found    = pressed(rubbed);
    const double growth = std::cbrt(found.P / 30.);
    across.push_back(found.xi / (0.167261 * growth));
    along.push_back(found.zeta / (0.700567 * growth));
    pressure.push_back(found.largest / (122.241 * growth));
  }
  EXPECT_NEAR(without_penalty(across, 5.), 1., 5e-3);
  EXPECT_NEAR(without_penalty(along, 5.), 1., 5e-3);
  EXPECT_NEAR(without_penalty(pressure, 5.), 1., 5e-3);
}
