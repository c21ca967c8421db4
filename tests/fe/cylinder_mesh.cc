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

  double cylinder_area(const ElasticBody<2> &body)
  {
    dealii::FEValues<2> values(body.cell_mapping(), body.dofs().get_fe(), dealii::QGauss<2>(4), dealii::update_JxW_values);
    double area = 0.;
    for (const auto &cell : body.dofs().active_cell_iterators())
      if (cell->material_id() == material_id::cylinder)
      {
        values.reinit(cell);
        for (const unsigned int q : values.quadrature_point_indices())
          area += values.JxW(q);
      }
    return area;
  }

  double product(const dealii::PETScWrappers::SparseMatrix &matrix, const dealii::Vector<double> &v)
  {
    dealii::Vector<double> result(v.size());
    for (auto entry = matrix.begin(); entry != matrix.end(); ++entry)
      result[entry->row()] += entry->value() * v[entry->column()];
    return v * result;
  }
} // namespace

// Nodes lie on the circle; between them edges of an angle 2 a are off by R a^4/32.
TEST(CylinderMesh, FollowsTheCircleFinelyWhereItTouches)
{
  for (const auto &[R, inner, size] : { std::tuple{ 56., 28., 0.25 }, { 21.1, 2., 0.25 }, { 21.1, 19., 0.1 } })
  {
    dealii::Triangulation<2> triangulation;
    make_bar({}, triangulation);
    const unsigned int n_bar_cells = triangulation.n_active_cells();
    const auto scene               = make_scene(R, inner, size);
    add_cylinder(scene, triangulation);
    auto properties                             = bar_properties({}, 0.3);
    properties.curved                           = true;
    properties.constants[material_id::cylinder] = { 70000., 0.3 };
    const ElasticBody<2> body(triangulation, properties);
    const auto &face  = body.cylinder_face();
    const double half = 0.1 * R + scene.layer.thickness;
    ASSERT_EQ(face.nodes.size(), 2 * face.edges.size() + 1);
    EXPECT_EQ(face.edges.size(), static_cast<unsigned int>(std::ceil(2. * half / size - 1e-6)));
    for (const auto &node : face.nodes)
      EXPECT_NEAR(node.position.norm(), R, 1e-11);
    const double first = std::atan2(face.edges.front().nodes.front().position[0], face.edges.front().nodes.front().position[1]);
    const double last  = std::atan2(face.edges.back().nodes.back().position[0], face.edges.back().nodes.back().position[1]);
    EXPECT_NEAR(first, -half / R, 1e-9);
    EXPECT_NEAR(last, half / R, 1e-9);
    // The coarsest edges, of pi/12, take pi/12^4/32 of the outer radius off.
    EXPECT_NEAR(cylinder_area(body), M_PI * (R * R - inner * inner), 1e-3 * R * R);
    unsigned int n_lever = 0;
    for (const auto &cell : triangulation.active_cell_iterators())
      n_lever += material_id::turns(cell->material_id()) ? 1 : 0;
    EXPECT_EQ(n_lever, n_bar_cells);
    EXPECT_EQ(body.friction_face().edges.size(), Bar().n);
  }
}

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
