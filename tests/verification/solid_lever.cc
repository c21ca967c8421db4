// SPDX-License-Identifier: GPL-3.0-only
#include "fe/body/cell_elasticity.h"
#include "scene/closed_form.h"
#include "scene/scene.h"
#include "support/made_mesh.h"
#include "verification/face_forces.h"
#include "verification/solid_run.h"

#include <deal.II/dofs/dof_tools.h>

#include <algorithm>
#include <gtest/gtest.h>

using namespace sprag;

namespace
{
  using Vector = Resultant::Vector;

  /// Returns the resultant of the hub's forces on the undeformed lever, from the stiffness of the cells beside the hub.
  Resultant hub_forces(const SolidBody &body, const dealii::Vector<double> &displacement)
  {
    Resultant result;
    const auto &fe = body.dofs().get_fe();
    std::vector<dealii::Point<3>> place(body.n_dofs());
    dealii::DoFTools::map_dofs_to_support_points(body.cell_mapping(), body.dofs(), place);
    std::vector<dealii::types::global_dof_index> dofs(fe.n_dofs_per_cell());
    CellElasticity<3> elasticity(body.cell_mapping(), fe, body.body_properties());
    dealii::FullMatrix<double> stiffness(dofs.size());
    dealii::Vector<double> cell_displacement(fe.n_dofs_per_cell()), forces(fe.n_dofs_per_cell());
    for (const auto &cell : body.dofs().active_cell_iterators())
    {
      cell->get_dof_indices(dofs);
      const auto is_held = [&](const auto dof) { return body.is_held(dof); };
      if (cell->material_id() == material_id::hub || std::none_of(dofs.begin(), dofs.end(), is_held))
        continue;
      for (unsigned int i = 0; i < dofs.size(); ++i)
        cell_displacement[i] = displacement[dofs[i]];
      elasticity.reinit(cell, cell_displacement);
      elasticity.assemble(stiffness, forces);
      for (unsigned int i = 0; i < dofs.size(); ++i)
        if (body.is_held(dofs[i]))
        {
          Vector force;
          force[fe.system_to_component_index(i).first] = forces[i];
          result.add(place[dofs[i]], force);
        }
    }
    return result;
  }

  /// Calls visit_state(body, lever, state, row) where a cylinder out of true in both directions presses.
  template <class StateVisitor>
  void visit_tilted_run(const StateVisitor &visit_state)
  {
    const Scene scene = tilted(solid_model_a(0.3), 2e-4, 1e-3);
    const MadeMesh plane(scene);
    const SolidBody body(scene, plane);
    StaticLever<3> lever(body, scene);
    unsigned int visited = 0;
    run_quasi_static(lever, scene.drive, { scene.analysis.step, scene.analysis.minimum_step, scene.contact },
                     [&](const State &state, const Row &row, const Evaluation &)
                     {
                       visited += row[Column::P] > 0.1 ? 1 : 0;
                       if (row[Column::P] > 0.1)
                         visit_state(body, lever, state, row);
                     });
    EXPECT_GT(visited, 20u);
  }
} // namespace

// The compliance of the face leaves something out where it ends, in the flange of a frame, and on the coarse cells of a plate,
// whose pads cover the whole width.
TEST(SolidLever, WithoutContractionItIsPlaneStress)
{
  const Scene bar     = solid_model_a(0.);
  Scene frame         = bar;
  frame.lever.outline = LeverOutline::frame;
  frame.frame.web     = frame.lever.width;
  for (const auto &[name, scene, tolerance] :
       { std::tuple{ "bar", bar, 1e-6 }, std::tuple{ "multipliers", with_augmented_lagrangian(bar), 1e-6 },
         std::tuple{ "frame", frame, 3e-6 }, std::tuple{ "plate", on_sensors(bar, 0.5 * bar.lever.width), 1e-5 } })
  {
    SCOPED_TRACE(name);
    const SolidRun solid(scene);
    const auto rows = run_scene(in_plane(scene));
    for (const Column column : { Column::P, Column::Q, Column::theta, Column::friction_work })
      EXPECT_LT(difference(rows, solid.rows, column), tolerance) << column_info(column).name;
    if (tolerance == 1e-6)
    {
      EXPECT_LT(difference(rows, solid.rows, Column::largest_pressure), 1e-5);
      EXPECT_LT(solid.exactness.displacement, 1e-5);
    }
    EXPECT_EQ(largest(solid.rows, Column::augmentations) > 0., scene.contact.enforcement == Enforcement::augmented_lagrangian);
    if (scene.plate.type == PlateType::on_sensors)
      EXPECT_LT(sensor_difference(rows, solid.rows), 1e-5);
  }
}

TEST(SolidLever, OneHalfIsEnoughWhereBothAreAlike)
{
  const Scene scene = solid_model_a(0.3);
  const SolidRun half(scene), whole(tilted(scene, 1e-12));
  for (const Column column : { Column::P, Column::Q, Column::theta, Column::largest_pressure, Column::elastic_energy })
    EXPECT_LT(difference(half.rows, whole.rows, column), 1e-6) << column_info(column).name;
}

// The spring carries the moment of all forces on the face about the pivot, where the face has moved to. The table's columns tell
// it but for how far the face moves along eta, and for the middle of the pressure in place of that of the forces along eta.
TEST(SolidLever, MomentsBalanceAboutThePivot)
{
  const Scene scene = solid_model_a(0.3);
  const double rest = kinematics(scene.geometry, 0.).theta;
  visit_tilted_run(
      [&](const SolidBody &body, const StaticLever<3> &, const State &state, const Row &row)
      {
        const double moment = scene.spring.stiffness * (row[Column::theta] - rest);
        EXPECT_NEAR(forces_on(body, state)[1].moment[2], moment, 1e-9 * moment);
        const double by_columns = row[Column::P] * row[Column::s] + row[Column::F] * scene.geometry.interface_offset;
        EXPECT_NEAR(by_columns, moment, 1e-4 * moment);
      });
}

// In linear theory the body is in balance where it is undeformed, about all axes. The table's twisting moment is that where the
// face has moved to, as all its places; along eta it moves by less than 0.05 mm.
TEST(SolidLever, TheHubCarriesTheForcesOfTheFace)
{
  const double offset = solid_model_a(0.3).geometry.interface_offset;
  visit_tilted_run(
      [&](const SolidBody &body, const StaticLever<3> &lever, const State &state, const Row &row)
      {
        const auto face_resultant = forces_on(body, state)[0];
        const auto hub_resultant  = hub_forces(body, lever.body_displacements(state.coordinates, state.forces).front());
        EXPECT_LT((face_resultant.force + hub_resultant.force).norm(), 1e-8 * face_resultant.force.norm());
        EXPECT_LT((face_resultant.moment + hub_resultant.moment).norm(), 1e-8 * face_resultant.moment.norm());
        const auto where_moved  = forces_on(body, state)[1];
        const double by_columns = offset * row.across[0] - row.across[2];
        EXPECT_GT(std::abs(row.across[2]), 1.);
        EXPECT_NEAR(where_moved.moment[0], by_columns, 0.05 * std::abs(row.across[0]));
      });
}
