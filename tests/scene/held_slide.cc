// SPDX-License-Identifier: GPL-3.0-only
#include "scene/held_slide.h"
#include "laws/friction_law.h"

#include "input/read.h"
#include "scene/scene.h"
#include "scenes.h"

#include <gtest/gtest.h>

using namespace sprag;

TEST(HeldDrive, IsTheDrivesLargestXUnlessGiven)
{
  Scene scene = model_a();
  EXPECT_DOUBLE_EQ(held_drive(scene).x, 65.);
  EXPECT_DOUBLE_EQ(held_drive(scene).v, -112.);
  scene.stability.position  = 30.;
  scene.stability.direction = Direction::forward;
  EXPECT_DOUBLE_EQ(held_drive(scene).x, 30.);
  EXPECT_DOUBLE_EQ(held_drive(scene).v, 112.);
}

TEST(HeldScene, FrictionByTheDrivesSpeedIsAConstant)
{
  const auto held = held_scene(with_friction_by_drive_speed(model_a()));
  EXPECT_NEAR(friction_coefficient(held.friction, 5.).coefficient, 0.72852016, 1e-8);
  EXPECT_DOUBLE_EQ(friction_coefficient(held.friction, 500.).derivative, 0.);
}

TEST(CriticalSearches, AutomaticRangesHoldTheScenesOwnValues)
{
  Scene scene          = model_a();
  scene.analysis.type  = AnalysisType::stability;
  scene.analysis.model = ModelType::beam;
  const auto range     = [&](const std::string &name)
  {
    const auto searches = critical_searches(scene).value();
    const auto found    = std::find_if(searches.begin(), searches.end(), [&](const auto &one) { return one.name == name; });
    return std::make_pair(found->from, found->to);
  };
  EXPECT_EQ(range("Lever/Depth"), std::make_pair(0.01 * 185.5, 30.)); // which holds 20 mm
  scene.lever.depth = 40.;
  EXPECT_EQ(range("Lever/Depth"), std::make_pair(0.01 * 185.5, 60.));
  scene.friction.factor = 4.;
  EXPECT_EQ(range("Friction/Factor"), std::make_pair(0., 6.));
  scene.drive = Drive(DriveProfile::triangle, 0., 65., 2000., 1.);
  EXPECT_EQ(range("Drive/Speed"), std::make_pair(1., 3000.));
  // A lever of a device thirteen times as small.
  scene.geometry.pivot_distance = 15.;
  scene.lever.depth             = 0.9;
  EXPECT_DOUBLE_EQ(range("Lever/Depth").first, 0.15);
  EXPECT_DOUBLE_EQ(range("Lever/Depth").second, 2.25);
}
