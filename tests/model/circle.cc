// SPDX-License-Identifier: GPL-3.0-only
#include "model/contact/circle.h"

#include "scene/closed_form.h"
#include "scene/scene.h"
#include "scenes.h"

#include <gtest/gtest.h>

using namespace sprag;

namespace
{
  constexpr unsigned int n = 4;
  using Coordinates        = dealii::Tensor<1, n>;

  // A raised pivot and a point off the ideal contact: nothing cancels.
  const Geometry geometry = { 56., 45.6, 185.5, 4. };
  const LeverPoint rest   = { 150., 45.9 };
  constexpr double x      = 23.;
  constexpr double theta  = 0.071;

  ContactKinematics<n> moved(const Coordinates &q)
  {
    return moving_circle_contact(placed_for_points(geometry, x + q[3], theta + q[2]), { rest.xi + q[0], rest.eta + q[1] });
  }

  Coordinates along(const unsigned int i, const double h)
  {
    Coordinates q;
    q[i] = h;
    return q;
  }
} // namespace

// Lengths here are about 1, 100 with the rotation's arm; central differences with step h (a rotation h / 100) err by h^2 / 6 of
// third derivatives and by 1e-14 mm / h of round-off in a gap of some 100 mm positions.
TEST(Circle, RowsAreTheDerivativesOfGapAndSlipAndCurvaturesThoseOfTheRows)
{
  const auto at_rest = moved({});
  for (unsigned int j = 0; j < n; ++j)
    for (const double h : { 1e-2, 1e-3, 1e-4, 1e-5 })
    {
      const double step    = j == 2 ? h / 100. : h;
      const auto right     = moved(along(j, step));
      const auto left      = moved(along(j, -step));
      const double allowed = (j == 2 ? 150. : 1.) * (1e-2 * h * h + 5e-14 / h);
      const auto gap_rows  = (right.gap_row - left.gap_row) / (2. * step);
      const auto slip_rows = (right.slip_row - left.slip_row) / (2. * step);
      EXPECT_NEAR(at_rest.gap_row[j], (right.gap - left.gap) / (2. * step), allowed) << j << ", h " << h;
      EXPECT_NEAR(at_rest.slip_row[j], (right.slip - left.slip) / (2. * step), allowed) << j << ", h " << h;
      for (unsigned int i = 0; i < n; ++i)
      {
        const double row_tolerance = (i == 2 ? 150. : 1.) * allowed;
        EXPECT_NEAR(at_rest.gap_curvature[i][j], gap_rows[i], row_tolerance) << i << j << ", h " << h;
        EXPECT_NEAR(at_rest.slip_curvature[i][j], slip_rows[i], row_tolerance) << i << j << ", h " << h;
      }
    }
}

TEST(Circle, IdealContactTouchesAtTheClosedFormsPoint)
{
  for (const auto &scene : { model_a(), model_b() })
    for (const double position : { 0., 20., 65. })
    {
      const auto ideal   = kinematics(scene.geometry, position);
      const auto contact = moving_circle_contact(placed_for_points(scene.geometry, position, ideal.theta),
                                                 { ideal.s, scene.geometry.interface_offset });
      // Round-off of coordinates of 200 mm; the gap's row is the face's normal.
      EXPECT_NEAR(contact.gap, 0., 1e-12);
      EXPECT_NEAR(contact.gap_row[0], 0., 1e-13);
      EXPECT_NEAR(contact.gap_row[1], 1., 1e-13);
      EXPECT_NEAR(contact.slip_row[0], 1., 1e-13);
    }
}

// The slip coordinate of the point under the ideal contact grows as the counterface slides along the lever: v cos th - e dth/dt,
// positive towards the pivot while x grows. Central differences over h = 1e-3 mm: h^2 / 6 of a third derivative below 1e-4.
TEST(Circle, SlipGrowsAtTheSlidingSpeedOfTheClosedForm)
{
  for (const auto &scene : { model_a(), model_b() })
    for (const double position : { 1., 20., 64. })
      for (const double speed : { 112., -112. })
      {
        const auto ideal    = kinematics(scene.geometry, position);
        const LeverPoint at = { ideal.s, scene.geometry.interface_offset };
        const auto slip     = [&](const double time)
        {
          const double here = position + speed * time;
          return moving_circle_contact(placed_for_points(scene.geometry, here, kinematics(scene.geometry, here).theta), at).slip;
        };
        const double dt = 1e-3 / 112.;
        EXPECT_NEAR((slip(dt) - slip(-dt)) / (2. * dt), sliding_speed(scene.geometry, position, speed), 1e-7);
      }
}
