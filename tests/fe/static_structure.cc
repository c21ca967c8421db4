// SPDX-License-Identifier: GPL-3.0-only
#include "fe/statics/static_structure.h"

#include "fe/meshed.h"
#include "fe/statics/lever_properties.h"
#include "fe/statics/static_interface.h"
#include "mpi_environment.h"
#include "scene/scene.h"
#include "scenes.h"

#include <gtest/gtest.h>

using namespace sprag;

namespace
{
  using Vector = dealii::Vector<double>;

  /// Model A's lever with so fine a face that it takes several tiles.
  class FactorisedLever
  {
  public:
    FactorisedLever()
    {
      Scene scene          = model_a();
      scene.mesh.face_size = 1.;
      make_mesh(scene, triangulation);
      body.emplace(triangulation, lever_properties(scene).body);
      body->reinit(stiffness);
      Vector forces(body->n_dofs());
      body->assemble(Vector(body->n_dofs()), stiffness, forces);
      cholesky.factorise(stiffness);
    }

    dealii::Triangulation<2> triangulation;
    std::optional<ElasticBody<2>> body;
    dealii::PETScWrappers::SparseMatrix stiffness;
    Mumps cholesky{ MatrixKind::positive_definite };
  };
} // namespace

// The selected inverse against back-substitutions with other factors, up to round-off times the condition of a slender lever.
TEST(SurfaceCompliance, IsThatOfSolvesWithUnitForces)
{
  FactorisedLever lever;
  Mumps lu;
  lu.factorise(lever.stiffness);
  const auto dofs = face_dofs(lever.body->friction_face());
  SurfaceCompliance compliance(lever.cholesky, dofs);
  ASSERT_GT(dofs.size(), 400u);

  // From the far end backwards, then across: tiles are found beside those that are known, below and above them.
  for (const DofSelection &surface_dofs : { DofSelection{ 300, 399 }, DofSelection{ 140 }, DofSelection{ 5, 150, 399 } })
  {
    const auto blocks = compliance.whole_blocks(surface_dofs);
    const auto matrix = compliance.among(blocks);
    for (const unsigned int surface_dof : surface_dofs)
    {
      const unsigned int column = find_index(surface_dof, blocks);
      Vector force(lever.body->n_dofs()), response;
      force[dofs[surface_dof]] = 1.;
      lu.solve(force, response);
      for (unsigned int i = 0; i < blocks.size(); ++i)
      {
        EXPECT_NEAR(matrix(i, column), response[dofs[blocks[i]]], 1e-9 * response.linfty_norm());
        EXPECT_EQ(matrix(column, i), matrix(i, column));
      }
    }
  }
}

TEST(SurfaceCompliance, SolvesStayThoseOfTheWholeMatrix)
{
  FactorisedLever lever;
  Vector force(lever.body->n_dofs()), before, after;
  force[face_dofs(lever.body->friction_face())[101]] = 1.;
  lever.cholesky.solve(force, before);
  lever.cholesky.compute_inverse_entries({ { 7, { 7, 9 } } });
  lever.cholesky.solve(force, after);
  EXPECT_GT(before.linfty_norm(), 0.);
  EXPECT_TRUE(before == after);
}
