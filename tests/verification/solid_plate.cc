// SPDX-License-Identifier: GPL-3.0-only
#include "scene/scene.h"
#include "verification/solid_run.h"

#include <numeric>

using namespace sprag;

namespace
{
  /// With a plate on four sensors at its corners.
  Scene on_sensors(const double poisson_ratio)
  {
    Scene scene               = solid_model_a(poisson_ratio);
    scene.plate.type          = PlateType::on_sensors;
    scene.plate.poisson_ratio = poisson_ratio;
    scene.plate.sensors       = { 105., 195. };
    scene.lever.outline       = LeverOutline::frame;
    scene.plate.sensor_width  = 8.;
    return scene;
  }

  Scene in_plane(Scene scene)
  {
    scene.analysis.dimension = 2;
    return scene;
  }

  double sum(const std::vector<double> &values)
  {
    return std::accumulate(values.begin(), values.end(), 0.);
  }

  /// Returns the sum of the right sensors' forces less that of the left ones.
  double right_less_left(const Row &row)
  {
    double result = 0.;
    for (std::size_t i = columns_across().size(); i < row.across.size(); i += 2)
      result += row.across[i + 1] - row.across[i];
    return result;
  }

  /// Largest difference of the places' forces over the largest of one.
  double sensor_difference(const std::vector<Row> &a, const std::vector<Row> &b)
  {
    EXPECT_EQ(a.size(), b.size());
    double difference = 0., largest = 0.;
    for (std::size_t k = 0; k < std::min(a.size(), b.size()); ++k)
      for (std::size_t i = 0; i < a[k].sensor_forces.size(); ++i)
      {
        difference = std::max(difference, std::abs(a[k].sensor_forces.at(i) - b[k].sensor_forces.at(i)));
        largest    = std::max(largest, std::abs(a[k].sensor_forces[i]));
      }
    return difference / largest;
  }
} // namespace

// Pads of half the width each make the sensors those of the plane, which press over the whole of it. What is left is what the
// compliance of the face leaves out of a plate on coarse cells.
TEST(SolidPlate, WithoutContractionOnPadsOfTheWholeWidthItIsThePlanes)
{
  Scene scene              = on_sensors(0.);
  scene.lever.outline      = LeverOutline::bar;
  scene.plate.sensor_width = 20.;
  const SolidRun solid(scene);
  const auto rows = run_scene(in_plane(scene));
  for (const Column column : { Column::P, Column::Q, Column::theta, Column::friction_work })
    EXPECT_LT(difference(rows, solid.rows, column), 1e-5) << column_info(column).name;
  EXPECT_LT(sensor_difference(rows, solid.rows), 1e-5);
}

// The sensors alone carry normal force and the moment about xi; the guide carries what draws the plate across at its back.
TEST(SolidPlate, TheSensorsCarryForceAndTwistingMoment)
{
  Scene scene         = tilted(on_sensors(0.3), 2e-4, 1e-3);
  scene.analysis.step = 4.;
  Mesh plane;
  make_mesh(scene, plane);
  const SolidBody body(scene, plane);
  StaticLever<3> lever(body, scene);
  const double back = scene.geometry.interface_offset + scene.layer.thickness + scene.plate.thickness;
  const double arm  = 0.5 * (scene.lever.width - scene.plate.sensor_width);
  unsigned int seen = 0;
  run_quasi_static(lever, scene.drive, { scene.analysis.step, scene.analysis.minimum_step, scene.contact },
                   [&](const State &state, const Row &row, const Evaluation &)
                   {
                     if (row[Column::P] < 1.)
                       return;
                     ++seen;
                     double normal = 0., twisting = 0., along = 0.;
                     const auto &nodes = body.friction_face().nodes;
                     for (unsigned int i = 0; i < state.forces.dofs.size(); ++i)
                       if (const unsigned int dof = state.forces.dofs[i]; dof < 3 * nodes.size())
                       {
                         const auto &place  = nodes[dof / 3].position;
                         const double force = state.forces.values[i];
                         normal += dof % 3 == 1 ? force : 0.;
                         twisting += dof % 3 == 1 ? force * place[2] : 0.;
                         twisting += dof % 3 == 2 ? force * (back - place[1]) : 0.;
                         along += dof % 3 == 2 ? std::abs(force) : 0.;
                       }
                     EXPECT_GT(along, 0.);
                     EXPECT_NEAR(sum(row.sensor_forces), normal, 1e-8 * normal);
                     EXPECT_NEAR(right_less_left(row) * arm, twisting, 1e-8 * normal * arm);
                     EXPECT_NEAR(row.across[2], twisting, 0.05 * std::abs(twisting));
                   });
  EXPECT_GT(seen, 10u);
}
