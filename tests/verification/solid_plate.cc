// SPDX-License-Identifier: GPL-3.0-only
#include "scene/scene.h"
#include "support/made_mesh.h"
#include "verification/solid_run.h"

using namespace sprag;

namespace
{
  /// Returns the sum of the right sensors' forces less that of the left ones.
  double right_less_left(const Row &row)
  {
    double result = 0.;
    for (std::size_t i = columns_across().size(); i < row.across.size(); i += 2)
      result += row.across[i + 1] - row.across[i];
    return result;
  }
} // namespace

// The sensors alone carry normal force and the moment about xi; the guide carries what draws the plate across at its back.
TEST(SolidPlate, TheSensorsCarryForceAndTwistingMoment)
{
  Scene scene         = tilted(on_sensors(solid_model_a(0.3), 8.), 2e-4, 1e-3);
  scene.lever.outline = LeverOutline::frame;
  scene.analysis.step = 4.;
  const MadeMesh plane(scene);
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
