// SPDX-License-Identifier: GPL-3.0-only
#include "model/contact/circle.h"

#include "scene/closed_form.h"
#include "scene/scene.h"
#include "scenes.h"

#include <gtest/gtest.h>

using namespace sprag;

TEST(Circle, IdealContactTouchesAtTheClosedFormsPoint)
{
  for (const auto &scene : { model_a(), model_b() })
    for (const double position : { 0., 20., 65. })
    {
      const auto ideal = kinematics(scene.geometry, position);
      const auto contact =
          on_circle(placed_circle(scene.geometry, position, ideal.theta), ideal.s, scene.geometry.interface_offset);
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
        const auto ideal = kinematics(scene.geometry, position);
        const auto slip  = [&](const double time)
        {
          const double here = position + speed * time;
          const auto circle = placed_circle(scene.geometry, here, kinematics(scene.geometry, here).theta);
          return on_circle(circle, ideal.s, scene.geometry.interface_offset).slip;
        };
        const double dt = 1e-3 / 112.;
        EXPECT_NEAR((slip(dt) - slip(-dt)) / (2. * dt), sliding_speed(scene.geometry, position, speed), 1e-7);
      }
}
