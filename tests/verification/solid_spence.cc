// SPDX-License-Identifier: GPL-3.0-only
#include "mpi_environment.h"
#include "verification/hertz_ball.h"

using namespace sprag;

namespace
{
  constexpr double R = 121.48, depth = 0.09874;

  struct Pressed
  {
    double P, largest = 0., stick; ///< the last: radius of what sticks over that of the contact
  };

  Pressed pressed(const SolidBlock &block, const NearFace &near, const double penalty, const double coefficient)
  {
    constexpr unsigned int steps = 16;
    RubbedBlock rubbed(block, near, { R, R, penalty });
    for (unsigned int i = 1; i <= steps; ++i)
      rubbed.move(RubbedBlock::Vector({ 0., -depth * i * i / (steps * steps), 0. }), coefficient);
    Pressed result{ rubbed.force()[1], 0., 0. };
    double area = 0., stick = 0.;
    for (const auto &point : rubbed.points())
    {
      area += point.area;
      stick += point.slipping ? 0. : point.area;
      result.largest = std::max(result.largest, point.pressure);
    }
    result.stick = std::sqrt(stick / area);
    return result;
  }
} // namespace

// A rigid ball pressed on a body that contracts nowhere (G = 0.5, nu = 0) with mu = 0.2986: points move inwards and slip at the
// edge, which makes the contact stiffer and its middle carry more. CONTACT (example spence35, 35 steps on 45 x 45 elements) finds
// 0.4705 and 0.02392 at a depth of 0.09874, without friction Hertz has 0.45597 and 0.018147; 225 of 921 elements stick. Ratios to
// the same block without friction leave out that it ends. The stick's edge lies in a cell of a / 6, so that c / a is uncertain by
// half of that.
TEST(SolidSpence, ABallPressedWithFrictionSlow)
{
  const auto parts = graded_parts(0.6, 4.2, 1.8, 80.);
  const SolidBlock block({ parts, graded_parts(0.6, 1.8, 1.8, 80.), parts }, { 1., 0. });
  const auto near = near_face(block, 5.5);
  std::vector<double> force, pressure, stick;
  for (const double penalty : { 4., 20. })
  {
    const auto smooth = pressed(block, near, penalty, 0.);
    const auto rough  = pressed(block, near, penalty, 0.2986);
    force.push_back(rough.P / smooth.P);
    pressure.push_back(rough.largest / smooth.largest);
    stick.push_back(rough.stick);
  }
  EXPECT_NEAR(without_penalty(force, 5.), 0.4705 / 0.45597, 3e-3);
  EXPECT_NEAR(without_penalty(pressure, 5.), 0.02392 / 0.018147, 0.03);
  EXPECT_NEAR(without_penalty(stick, 5.), std::sqrt(225. / 921.), 0.085);
}
