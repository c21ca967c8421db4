// SPDX-License-Identifier: GPL-3.0-only
#include "fe/mesh/lever_mesh.h"

#include "bar_on_elastic_cylinder.h"
#include "base/errors.h"
#include "fe/dynamics/inertial_matrices.h"
#include "mpi_environment.h"
#include "scene/scene.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_values.h>

#include <cmath>
#include <gtest/gtest.h>

using namespace sprag;

namespace
{
  Scene make_scene(const double radius, const double inner_radius, const double face_size)
  {
    Scene scene;
    scene.geometry.cylinder_radius = radius;
    scene.cylinder.type            = CylinderType::solid;
    scene.cylinder.inner_radius    = inner_radius;
    scene.cylinder.face_size       = face_size;
    return scene;
  }

  double product(const dealii::PETScWrappers::SparseMatrix &matrix, const dealii::Vector<double> &v)
  {
    dealii::Vector<double> result(v.size());
    for (auto entry = matrix.begin(); entry != matrix.end(); ++entry)
      result[entry->row()] += entry->value() * v[entry->column()];
    return v * result;
  }
} // namespace

TEST(CylinderMesh, RefusesFacetsAndACoreThatLeavesNothing)
{
  dealii::Triangulation<2> triangulation;
  make_bar({}, triangulation);
  auto scene        = make_scene(21.1, 5., 0.25);
  scene.mesh.degree = 1;
  EXPECT_THROW(add_cylinder(scene, triangulation), InputError);
  scene = make_scene(21.1, 21.1, 0.25);
  EXPECT_THROW(add_cylinder(scene, triangulation), InputError);
}

// A cylinder adds its own mass to the coordinates of its own nodes, and nothing to what the lever weighs.
TEST(CylinderMesh, DoesNotTurnWithTheLever)
{
  const MeshedPair pair;
  const MeshedBar bar(bar_on_cylinder());
  auto inertia = bar_inertia(0.5, 0.);
  const InertialMatrices alone(*bar, inertia);
  const double density                     = 1e-6;
  inertia.densities[material_id::cylinder] = density;
  const InertialMatrices matrices(*pair, inertia);
  EXPECT_NEAR(matrices.density_factor, alone.density_factor, 1e-12 * alone.density_factor);
  EXPECT_NEAR(matrices.total_mass, alone.total_mass, 1e-12 * alone.total_mass);
  const auto turn = matrices.coordinates.rigid_rotation();
  EXPECT_NEAR(product(matrices.mass, turn), 0.5, 1e-9);
  for (unsigned int d = 0; d < 2; ++d)
    EXPECT_NEAR(matrices.momentum[d] * turn, alone.momentum[d] * alone.coordinates.rigid_rotation(), 1e-12);
  // All free nodes of the cylinder along xi: the mass but for what its core holds.
  dealii::Vector<double> along(matrices.coordinates.size());
  std::vector<dealii::types::global_dof_index> dofs((*pair).dofs().get_fe().n_dofs_per_cell());
  for (const auto &cell : (*pair).dofs().active_cell_iterators())
    if (cell->material_id() == material_id::cylinder)
    {
      cell->get_dof_indices(dofs);
      for (unsigned int i = 0; i < dofs.size(); ++i)
      {
        const auto dof = static_cast<unsigned int>(dofs[i]);
        EXPECT_EQ(matrices.coordinates.arm(dof), 0.);
        if (!(*pair).is_held(dof) && (*pair).dofs().get_fe().system_to_component_index(i).first == 0)
          along[matrices.coordinates.mover(dof).coordinate] = 1.;
      }
    }
  EXPECT_EQ(matrices.momentum[0] * along, 0.);
  const double mass = density * 4. * M_PI * (36. - 9.);
  EXPECT_LT(product(matrices.mass, along), mass);
  EXPECT_GT(product(matrices.mass, along), 0.8 * mass);
}
