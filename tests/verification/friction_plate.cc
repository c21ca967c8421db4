// SPDX-License-Identifier: GPL-3.0-only
#include "scene/scene.h"
#include "verification/meshed_in_time.h"
#include "verification/run_scene.h"

#include <gtest/gtest.h>
#include <numeric>

using namespace sprag;

namespace
{
  Scene with_plate(Scene scene, const LeverOutline outline)
  {
    scene.mesh.face_size = 1.;
    scene.lever.outline  = outline;
    scene.plate.type     = PlateType::on_sensors;
    return scene;
  }

  double sum(const std::vector<double> &values)
  {
    return std::accumulate(values.begin(), values.end(), 0.);
  }

  /// Returns the position of the sensors' resultant [mm].
  double middle(const std::vector<double> &forces, const std::vector<double> &sensors)
  {
    return std::inner_product(forces.begin(), forces.end(), sensors.begin(), 0.) / sum(forces);
  }
} // namespace

TEST(FrictionPlate, WithoutInertiaTheSensorsCarryTheContact)
{
  for (const auto &model : { model_a(), model_b() })
    for (const auto outline : { LeverOutline::bar, LeverOutline::frame })
    {
      const auto scene = with_step(with_plate(model, outline), 5.);
      for (const auto &row : run_scene(scene))
      {
        ASSERT_EQ(row.sensor_forces.size(), 4u);
        EXPECT_NEAR(sum(row.sensor_forces), row[Column::P], 1e-8 * std::max(1., row[Column::P])) << row[Column::x];
        if (row[Column::P] < 1.)
          continue;
        // The guide holds the plate at its back: friction in front of it tilts the plate, one way forth and the other way back. s
        // is told to a part of the contact's width.
        const double height = scene.layer.thickness + scene.plate.thickness;
        const double lever  = row[Column::s] - row[Column::F] / row[Column::P] * height;
        EXPECT_NEAR(middle(row.sensor_forces, scene.plate.sensors), lever, 0.3) << row[Column::x];
      }
    }
}

TEST(FrictionPlate, InTimeTheSensorsMissThePlatesMomentum)
{
  Scene scene         = with_fixed_step(in_time(with_plate(model_a(), LeverOutline::frame), ModelType::condensed), 4e-5);
  scene.lever.inertia = InertiaSource::as_built;
  scene.drive         = Drive(DriveProfile::triangle, 57., 65., 112., 1., 5e-3);
  const auto rows     = run_meshed_in_time(scene).rows;
  double missed       = 0.;
  double largest      = 0.;
  for (std::size_t i = 1; i < rows.size(); ++i)
  {
    const auto difference = [&](const Row &row) { return row[Column::P] - sum(row.sensor_forces); };
    missed += 0.5 * (difference(rows[i]) + difference(rows[i - 1])) * (rows[i][Column::time] - rows[i - 1][Column::time]);
    largest = std::max(largest, std::abs(difference(rows[i])));
  }
  // Plate and layer of 40 mm width from 95 to 205 mm turn with the lever.
  const double mass     = 40. * 110. * (8. * 2.7e-9 + 1. * 2e-10);
  const double momentum = mass * 150. * (rows.back()[Column::theta_rate] - rows.front()[Column::theta_rate]);
  // P of a row is that of the step's end, what moves the plate its mean over the step. Between the points that a narrow contact
  // takes up and leaves both differ by 0.005 N in steps of 1e-4 s, which is 40 % of the momentum, 7 % in steps of 4e-5 s and 3 %
  // in steps of 2e-5 s. The static shapes of the condensed model follow the force by its relaxation of 2e-5 s: 1e-3 N where P
  // changes by 50 N/s, or 6 % of the momentum in the 0.14 s that the ringing takes to die down.
  EXPECT_NEAR(missed, momentum, 0.12 * std::abs(momentum));
  EXPECT_GT(largest, 0.05 * rows.front()[Column::P]);
}
