// SPDX-License-Identifier: GPL-3.0-only
#include "fe/body/cell_elasticity.h"

#include "fe/body/elastic_body.h"
#include "fe/body/material.h"
#include "fe/fields/body_fields.h"
#include "fe/statics/lever_properties.h"
#include "mpi_environment.h"
#include "scene/scene.h"
#include "scenes.h"
#include "support/random_vector.h"
#include "support/solid.h"
#include "verification/block.h"

#include <deal.II/dofs/dof_tools.h>
#include <deal.II/grid/grid_tools.h>
#include <deal.II/lac/lapack_full_matrix.h>

#include <cmath>
#include <gtest/gtest.h>

using namespace sprag;

namespace
{
  using Matrix   = dealii::PETScWrappers::SparseMatrix;
  using Vector   = dealii::Vector<double>;
  using Gradient = dealii::Tensor<2, 2>;

  const double nearly_half = 0.4999;
  const double width       = 3.;

  /// Free, of cells that are no parallelograms.
  void make_free_block(dealii::Triangulation<2> &triangulation)
  {
    make_block({ 1., 1.5, 2.6, 4. }, { 0., 0.3, 1.2, 2. }, triangulation);
    for (const auto &face : triangulation.active_face_iterators())
      if (face->at_boundary())
        face->set_boundary_id(0);
    dealii::GridTools::transform(
        [](const dealii::Point<2> &p)
        { return dealii::Point<2>(p[0] + 0.1 * std::sin(2. * p[0] + p[1]), p[1] + 0.1 * std::sin(3. * p[0])); },
        triangulation);
  }

  /// u = gradient X of all nodes.
  Vector affine(const ElasticBody<2> &body, const Gradient &gradient)
  {
    std::vector<dealii::Point<2>> positions(body.n_dofs());
    dealii::DoFTools::map_dofs_to_support_points(body.cell_mapping(), body.dofs(), positions);
    const auto across = dealii::DoFTools::extract_dofs(body.dofs(), dealii::ComponentMask(std::vector<bool>{ false, true }));
    Vector result(body.n_dofs());
    for (unsigned int i = 0; i < result.size(); ++i)
      result[i] = gradient[across.is_element(i) ? 1 : 0] * positions[i];
    return result;
  }

  struct System
  {
    dealii::LAPACKFullMatrix<double> stiffness;
    Vector forces;
  };

  System assembled(const ElasticBody<2> &body, const Vector &displacement)
  {
    Matrix matrix;
    body.reinit(matrix);
    System result{ dealii::LAPACKFullMatrix<double>(body.n_dofs()), Vector(body.n_dofs()) };
    body.assemble(displacement, matrix, result.forces);
    for (const auto &entry : matrix)
      result.stiffness(entry.row(), entry.column()) = entry.value();
    return result;
  }
} // namespace

TEST(CellElasticity, EachMaterialHasItsOwnPlane)
{
  dealii::Triangulation<2> triangulation;
  make_free_block(triangulation);
  const auto G = gradient(0.03, 0.04, -0.02, 0.01);
  for (const auto plane : { PlaneState::strain, PlaneState::stress })
  {
    auto properties   = soft_solid(2, MaterialModel::linear, 0.3);
    properties.plane  = plane == PlaneState::strain ? PlaneState::stress : PlaneState::strain;
    properties.planes = { { material_id::lever, plane } };
    const ElasticBody<2> body(triangulation, properties);
    const auto stress   = compute_stress<2>(MaterialModel::linear, plane_constants({ 20., 0.3 }, plane), G).piola;
    const double energy = 0.5 * scalar_product(stress, G) * dealii::GridTools::volume(triangulation) * width;
    EXPECT_NEAR(body.energy(affine(body, G)), energy, 1e-13 * energy);
  }
  const auto parts = lever_properties(model_a()).body;
  EXPECT_EQ(parts.plane_state(material_id::lever), PlaneState::stress);
  EXPECT_EQ(parts.plane_state(material_id::layer), PlaneState::strain);
  EXPECT_EQ(parts.plane_state(material_id::cylinder), PlaneState::strain);
}

// Only two translations and the rotation of a free body cost no energy: there is no hourglass. The bound lies between the
// round-off of the largest eigenvalue, some lambda, and the softest true deformation, some tenths of mu.
TEST(CellElasticity, OnlyRigidMotionsCostNothing)
{
  dealii::Triangulation<2> triangulation;
  make_free_block(triangulation);
  for (const unsigned int degree : { 1u, 2u })
  {
    const ElasticBody<2> body(triangulation, soft_solid(degree, MaterialModel::linear, nearly_half));
    auto stiffness = assembled(body, Vector(body.n_dofs())).stiffness;
    double largest = 0., asymmetry = 0.;
    for (unsigned int i = 0; i < body.n_dofs(); ++i)
      for (unsigned int j = 0; j < body.n_dofs(); ++j)
      {
        largest   = std::max(largest, std::abs(stiffness(i, j)));
        asymmetry = std::max(asymmetry, std::abs(stiffness(i, j) - stiffness(j, i)));
      }
    EXPECT_LE(asymmetry, 1e-14 * largest);
    stiffness.compute_eigenvalues();
    unsigned int free = 0;
    for (unsigned int i = 0; i < body.n_dofs(); ++i)
    {
      const double value = stiffness.eigenvalue(i).real();
      EXPECT_TRUE(std::abs(value) < 1e-13 * largest * body.n_dofs() || value > 0.01 * width) << value;
      free += value < 0.01 * width ? 1 : 0;
    }
    EXPECT_EQ(free, 3u);
  }
}

// lambda, 3e3 times larger than mu, is in the derivatives and in the round-off alike. Displacements of 0.01 mm are a thirtieth of
// the smallest cell.
TEST(CellElasticity, TangentAndForcesAreDerivativesOfTheEnergyAtFiniteStrain)
{
  dealii::Triangulation<2> triangulation;
  make_free_block(triangulation);
  for (const unsigned int degree : { 1u, 2u })
  {
    const ElasticBody<2> body(triangulation, soft_solid(degree, MaterialModel::neo_hookean, nearly_half));
    const auto u         = random_vector(body.n_dofs(), 0.01, 1);
    const auto direction = random_vector(body.n_dofs(), 1., 2);
    const auto at        = assembled(body, u);
    Vector product(body.n_dofs());
    at.stiffness.vmult(product, direction);
    for (const double h : { 1e-4, 1e-5 })
    {
      Vector right = u, left = u;
      right.add(h, direction);
      left.add(-h, direction);
      Vector divided = assembled(body, right).forces;
      divided -= assembled(body, left).forces;
      divided /= 2. * h;
      divided -= product;
      EXPECT_LE(divided.linfty_norm(), (1e4 * h * h + 1e-13 / h) * product.linfty_norm()) << h;
      const double slope = at.forces * direction;
      EXPECT_NEAR((body.energy(right) - body.energy(left)) / (2. * h), slope, (1e6 * h * h + 1e-11 / h) * std::abs(slope)) << h;
    }
  }
}

// The pressure of degree 1 is one in a cell, whatever its displacements; so is the stress out of plane, lambda theta.
TEST(CellElasticity, StressOfFieldsHasTheProjectedPressure)
{
  dealii::Triangulation<2> triangulation;
  make_block({ 1., 2. }, { 0., 0.7 }, triangulation);
  for (const auto material : { MaterialModel::linear, MaterialModel::neo_hookean })
  {
    const ElasticBody<2> body(triangulation, soft_solid(1, material, nearly_half));
    const BodyFields fields(body);
    for (const unsigned int seed : { 1, 2, 3, 4 })
    {
      const auto nodes      = fields.at(random_vector(body.n_dofs(), 0.01, seed));
      const double pressure = nodes.front().stress[2][2];
      for (const auto &node : nodes)
      {
        if (material == MaterialModel::linear)
          EXPECT_NEAR(node.stress[2][2], pressure, 1e-12 * std::abs(pressure));
        // J of up to 1.2 stands between the pressure and Cauchy's stress.
        else
          EXPECT_NEAR(node.stress[2][2], pressure, 0.4 * std::abs(pressure));
        // The rest of the stress is mu times strains of some tenths.
        EXPECT_NEAR(node.stress[0][0], node.stress[2][2], 10.);
      }
    }
  }
}
