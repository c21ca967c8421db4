#include "scene/closed_form.h"
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

  void expect_twice(const Row &both, const Row &single, const std::string &name)
  {
    const auto &of_levers = columns_of_a_lever();
    for (std::size_t c = 0; c < of_levers.size(); ++c)
      if (const double value = single[of_levers[c]]; !std::isnan(value))
      {
        EXPECT_EQ(both[of_levers[c]], value) << name << ", " << column_info(of_levers[c]).name;
        EXPECT_EQ(both.second_lever()[c], value) << name << ", second lever, " << column_info(of_levers[c]).name;
      }
    EXPECT_EQ(both.lateral_force(), 0.) << name;
    for (const auto column : { Column::friction_work, Column::drive_work, Column::spring_energy, Column::elastic_energy })
      EXPECT_EQ(both[column], 2. * single[column]) << name << ", " << column_info(column).name;
    auto sensors = single.sensor_forces;
    sensors.insert(sensors.end(), single.sensor_forces.begin(), single.sensor_forces.end());
    EXPECT_EQ(both.sensor_forces, sensors) << name;
  }
} // namespace

// Both levers do the same in the same order, whatever they are made of, and the joint adds nothing to the last digit.
TEST(MirroredPair, WithoutOffsetIsASingleLeverTwice)
{
  const Scene linear                                        = coarse_scene();
  const std::vector<std::pair<std::string, Scene>> of_parts = { { "linear", linear },
                                                                { "hardening spring", with_hardening(linear) },
                                                                { "augmented Lagrangian", with_augmented_lagrangian(linear) },
                                                                { "neo-Hookean", with_neo_hookean(linear) },
                                                                { "elastic cylinder", on_solid_cylinder(linear, 200., 0.5) },
                                                                { "plate", with_plate(linear) } };
  for (const auto &[name, scene] : of_parts)
  {
    const auto single = run_scene(scene);
    for (const auto joint : { SpringJoint::held, SpringJoint::free })
    {
      const auto rows = run_scene(paired(scene, joint));
      ASSERT_EQ(rows.size(), single.size()) << name;
      for (std::size_t i = 0; i < rows.size(); ++i)
        expect_twice(rows[i], single[i], name + ", row " + std::to_string(i));
    }
  }
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
