// SPDX-License-Identifier: GPL-3.0-only
#include "mpi_environment.h"
#include "verification/hertz_ball.h"

using namespace sprag;

// A cylinder so large that it is flat over the block presses with its sharp ends, without friction on a body without contraction:
// in the plane across its axis a rigid punch, p = P' / (pi sqrt(c^2 - zeta^2)) on a half-plane, P' per length along xi. The block
// of 20 c changes that by the square of c over its size. The bed of the penalty yields beside the ends, to some E / penalty from
// them.
TEST(SolidPunch, EndsOfACylinderPressAsTheSquareRootSays)
{
  constexpr double half_length = 1., thickness = 1., modulus = 1000., cell = 0.05;
  const auto fine = graded_parts(cell, 1.2, 1.3, 20.);
  const SolidBlock block({ { -0.5 * thickness, 0.5 * thickness }, graded_parts(cell, 0.2, 1.3, 20.), fine }, { modulus, 0. });
  const auto near = near_face(block, 1.21);
  RubbedBlock rubbed(block, near, { 1e4, 0., 5e5, 2. * half_length });
  rubbed.move(RubbedBlock::Vector({ 0., -0.005, 0. }), 0.);

  const double mean  = rubbed.force()[1] / (2. * half_length * thickness);
  double within_half = 0., beyond = 0., largest = 0.;
  for (const auto &point : rubbed.points())
  {
    const double share = point.area * point.pressure / rubbed.force()[1];
    within_half += point.zeta < 0.5 * half_length ? share : 0.;
    beyond += point.zeta > 0.9 * half_length ? share : 0.;
    largest = std::max(largest, point.pressure);
  }
  EXPECT_NEAR(within_half, 2. / M_PI * std::asin(0.5), 1e-3);
  EXPECT_NEAR(beyond, 1. - 2. / M_PI * std::asin(0.9), 1e-3);
  EXPECT_GT(largest, 5. * mean);
}
