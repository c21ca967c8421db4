// SPDX-License-Identifier: GPL-3.0-only
#include "scene/closed_form.h"
#include "scene/scene.h"
#include "support/scene_parts.h"
#include "verification/run_scene.h"

#include <gtest/gtest.h>
#include <string>

using namespace sprag;

namespace
{
  Scene coarse_scene()
  {
    Scene scene = with_face_size(model_a(), 2.);
    scene.drive = Drive(DriveProfile::triangle, 0., 3., 112., 1.);
    return scene;
  }

  Scene with_neo_hookean(Scene scene)
  {
    scene.lever.material = MaterialModel::neo_hookean;
    scene.analysis.plane = PlaneState::strain;
    return scene;
  }

  Scene with_plate(Scene scene)
  {
    scene.plate.type = PlateType::on_sensors;
    return scene;
  }

  Scene with_hardening(Scene scene)
  {
    scene.spring = with_cubic_hardening(scene.spring.stiffness, 8e3);
    return scene;
  }

  /// A column of a run against that of another, up to round-off: both levers of a pair are solved in one system. Steps through
  /// stick lie elsewhere by 1e-9 of x, and slip speeds on an elastic cylinder change there by 4e-7 of their peak.
  template <class Found, class Expected>
  void expect_same(const std::string &name, const std::size_t rows, const Found &found, const Expected &expected)
  {
    constexpr double round_off = 1e-7; // mm, N mm: of differences of large numbers
    const double share         = name.find("v_rel") != std::string::npos ? 1e-6 : 3e-7;
    double peak                = 0.;
    for (std::size_t i = 0; i < rows; ++i)
      peak = std::max(peak, std::isnan(expected(i)) ? 0. : std::abs(expected(i)));
    for (std::size_t i = 0; i < rows; ++i)
      if (!std::isnan(expected(i)))
      {
        EXPECT_NEAR(found(i), expected(i), share * peak + round_off) << name << ", row " << i;
      }
  }

  void expect_twice(const std::vector<Row> &both, const std::vector<Row> &single, const std::string &name)
  {
    using Index           = std::size_t;
    const auto &per_lever = lever_columns();
    for (Index c = 0; c < per_lever.size(); ++c)
    {
      const auto single_value = [&](const Index i) { return single[i][per_lever[c]]; };
      const auto column       = name + ", " + column_info(per_lever[c]).name;
      expect_same(
          column, both.size(), [&](const Index i) { return both[i][per_lever[c]]; }, single_value);
      expect_same(
          column + " of the second lever", both.size(), [&](const Index i) { return both[i].second_lever()[c]; }, single_value);
    }
    for (const auto column : { Column::friction_work, Column::drive_work, Column::spring_energy, Column::elastic_energy })
      expect_same(
          name + ", " + column_info(column).name, both.size(), [&](const Index i) { return both[i][column]; },
          [&](const Index i) { return 2. * single[i][column]; });
    const auto sensors = single.front().sensor_forces.size();
    ASSERT_EQ(both.front().sensor_forces.size(), 2 * sensors);
    for (Index s = 0; s < 2 * sensors; ++s)
      expect_same(
          name + ", sensor", both.size(), [&](const Index i) { return both[i].sensor_forces[s]; },
          [&](const Index i) { return single[i].sensor_forces[s % sensors]; });
    for (const Row &row : both)
      EXPECT_NEAR(row.lateral_force(), 0., 1e-7) << name; // of 17 N
  }
} // namespace

// Both levers do the same in the same order, whatever they are made of, and the joint adds nothing.
TEST(MirroredPairSlow, WithoutOffsetIsASingleLeverTwice)
{
  const Scene linear                                           = coarse_scene();
  const std::vector<std::pair<std::string, Scene>> part_scenes = { { "linear", linear },
                                                                   { "hardening spring", with_hardening(linear) },
                                                                   { "augmented Lagrangian", with_augmented_lagrangian(linear) },
                                                                   { "neo-Hookean", with_neo_hookean(linear) },
                                                                   { "elastic cylinder", on_solid_cylinder(linear, 200., 0.5) },
                                                                   { "plate", with_plate(linear) } };
  for (const auto &[name, scene] : part_scenes)
  {
    const auto single = run_scene(scene);
    for (const auto joint : { SpringJoint::held, SpringJoint::free })
    {
      const auto rows = run_scene(paired(scene, joint));
      ASSERT_EQ(rows.size(), single.size()) << name;
      expect_twice(rows, single, name);
    }
  }
}

// The frame carries both levers, on twice the stiffness of one's; what they push it with moves it, however it is shared.
TEST(MirroredPair, ThatDiffersIsCarriedByItsSprungFrame)
{
  Scene scene             = paired(coarse_scene(), SpringJoint::free, 0.3, 0.8);
  scene.support.type      = SupportType::sprung;
  scene.support.stiffness = 50.;
  const auto rows         = run_scene(scene);
  double unequal          = 0.;
  for (const Row &row : rows)
  {
    const double second = row.second_value(Column::Q);
    EXPECT_NEAR(2. * scene.support.stiffness * row[Column::support_displacement], row[Column::Q] + second, 1e-8);
    unequal = std::max(unequal, std::abs(row[Column::Q] - second));
  }
  EXPECT_GT(unequal, 0.05); // N
  const Row &last = rows.back();
  EXPECT_NEAR(last[Column::drive_work], last[Column::friction_work], 2e-3 * last[Column::friction_work]);
}

// A cylinder off the middle presses on the first lever from the start; nothing has been rubbed then.
TEST(MirroredPair, ACylinderOffTheMiddleIsPutBetweenTheLeversWithoutFriction)
{
  for (const auto enforcement : { Enforcement::penalty, Enforcement::augmented_lagrangian })
  {
    Scene scene               = paired(coarse_scene(), SpringJoint::held, 0.5);
    scene.contact.enforcement = enforcement;
    scene.drive               = Drive(DriveProfile::triangle, 0., 1., 112., 0.5);
    const auto rows           = run_scene(scene);
    const Row &start          = rows.front();
    const double turn         = start[Column::theta] - kinematics(scene.geometry, 0.).theta;
    EXPECT_NEAR(turn, 0.5 / (scene.geometry.pivot_distance * std::cos(start[Column::theta])), 0.1 * turn); // less what yields
    EXPECT_NEAR(start[Column::F], 0., 1e-3 * start[Column::P]);
    EXPECT_NEAR(start[Column::P] * start[Column::s], scene.spring.stiffness * turn, 2e-3 * scene.spring.stiffness * turn);
    EXPECT_EQ(start[Column::friction_resultant], 0.);
    EXPECT_EQ(start.drive_force(), start[Column::Q]); // the second lever is apart
    EXPECT_GT(rows.back()[Column::F], 0.5 * rows.back()[Column::P]);
  }
}
