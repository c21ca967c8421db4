// SPDX-License-Identifier: GPL-3.0-only
#include "fe/body/elastic_body.h"

#include "fe/algebra/mumps.h"
#include "mpi_environment.h"
#include "support/random_vector.h"
#include "support/solid.h"
#include "verification/block.h"

#include <deal.II/dofs/dof_tools.h>
#include <deal.II/grid/grid_tools.h>

#include <cmath>
#include <gtest/gtest.h>

using namespace sprag;

namespace
{
  using Matrix       = dealii::PETScWrappers::SparseMatrix;
  using Vector       = dealii::Vector<double>;
  const double width = 3.;

  /// 4 x 2 mm, cells of unequal size and, for generality, not rectangular.
  std::unique_ptr<dealii::Triangulation<2>> small_block()
  {
    auto triangulation = std::make_unique<dealii::Triangulation<2>>();
    make_block({ 1., 1.5, 2.6, 4., 5. }, { 0., 0.3, 1.2, 2. }, *triangulation);
    dealii::GridTools::transform(
        [](const dealii::Point<2> &p)
        { return dealii::Point<2>(p[0] + 0.05 * std::sin(p[0] * p[1]) * p[1] * (2. - p[1]) * (p[0] - 1.) * (5. - p[0]), p[1]); },
        *triangulation);
    return triangulation;
  }

  /// Displacements with none on the held side.
  Vector random_displacement(const ElasticBody<2> &body, const double size, const unsigned int seed)
  {
    Vector result   = random_vector(body.n_dofs(), size, seed);
    const auto held = dealii::DoFTools::extract_boundary_dofs(body.dofs(), {}, { boundary_id::hub });
    for (const auto dof : held)
      result[dof] = 0.;
    return result;
  }

  /// Stiffness times `direction` at `displacement`, and the internal forces there.
  std::pair<Vector, Vector> product_and_forces(const ElasticBody<2> &body, const Vector &displacement, const Vector &direction)
  {
    Matrix matrix;
    body.reinit(matrix);
    Vector forces(body.n_dofs()), product(body.n_dofs());
    body.assemble(displacement, matrix, forces);
    for (const auto &entry : matrix)
      product[entry.row()] += entry.value() * direction[entry.column()];
    return { product, forces };
  }
} // namespace

TEST(ElasticBody, LinearForcesAreStiffnessTimesDisplacement)
{
  const auto triangulation = small_block();
  for (const unsigned int degree : { 1u, 2u })
  {
    const ElasticBody<2> body(*triangulation, soft_solid(degree, MaterialModel::linear, 0.3));
    const auto displacement      = random_displacement(body, 1., 1);
    const auto [product, forces] = product_and_forces(body, displacement, displacement);
    Vector difference            = product;
    difference -= forces;
    EXPECT_LE(difference.linfty_norm(), 1e-13 * forces.linfty_norm());
    EXPECT_NEAR(body.energy(displacement), 0.5 * (forces * displacement), 1e-13 * body.energy(displacement));
  }
}

TEST(ElasticBody, HeldNodesAreNotMovedByAnything)
{
  const auto triangulation = small_block();
  const ElasticBody<2> body(*triangulation, soft_solid(1, MaterialModel::linear, 0.3));
  Matrix matrix;
  body.reinit(matrix);
  Vector forces(body.n_dofs());
  body.assemble(random_displacement(body, 1., 1), matrix, forces);
  for (const auto dof : dealii::DoFTools::extract_boundary_dofs(body.dofs(), {}, { boundary_id::hub }))
  {
    EXPECT_EQ(forces[dof], 0.);
    for (auto entry = matrix.begin(dof); entry != matrix.end(dof); ++entry)
      if (entry->column() == dof)
        EXPECT_GT(entry->value(), 0.);
      else
        EXPECT_EQ(entry->value(), 0.);
  }
}

TEST(ElasticBody, MassAndInertiaOfARectangleAreExact)
{
  dealii::Triangulation<2> triangulation;
  make_block({ 1., 1.5, 2.6, 4., 5. }, { 0., 0.3, 1.2, 2. }, triangulation);
  const ElasticBody<2> body(triangulation, soft_solid(1, MaterialModel::linear, 0.3));
  const auto [mass, inertia] = body.mass_and_inertia(2.7e-9);
  const double expected      = 2.7e-9 * 4. * 2. * width;
  EXPECT_NEAR(mass, expected, 1e-14 * expected);
  // (b^2 + h^2) / 12 about the centre at (3, 1)
  EXPECT_NEAR(inertia, expected * (20. / 12. + 10.), 1e-13 * expected * 12.);
}

TEST(ElasticBody, PointsOfTheFaceStandForItsAreaAndAreOrdered)
{
  dealii::Triangulation<2> triangulation;
  make_block({ 1., 1.5, 2.6, 4., 5. }, { 0.2, 1.2, 2. }, triangulation);
  for (const unsigned int degree : { 1u, 2u })
  {
    const ElasticBody<2> body(triangulation, soft_solid(degree, MaterialModel::linear, 0.3));
    const auto &face = body.friction_face();
    double area      = 0.;
    double last      = 0.;
    for (const auto &point : face.points)
    {
      area += point.weight;
      EXPECT_GT(point.position[0], last);
      EXPECT_NEAR(point.position[1], 0.2, 1e-15);
      last = point.position[0];
    }
    EXPECT_NEAR(area, 4. * width, 1e-13 * area);
    EXPECT_EQ(face.nodes.size(), 4 * degree + 1);
    EXPECT_EQ(face.elements.size(), 4u);
    EXPECT_DOUBLE_EQ(face.depth, 1.);
    EXPECT_EQ(face.young_modulus, 20.);
  }
}

// Nodal forces of a uniform pressure on a side of length h: (1, 1) h / 2 at degree 1, (1, 4, 1) h / 6 at degree 2.
TEST(ElasticBody, UniformPressureIsIntegratedExactly)
{
  dealii::Triangulation<2> triangulation;
  make_block({ 1., 1.5, 2.6 }, { 0., 1. }, triangulation);
  for (const unsigned int degree : { 1u, 2u })
  {
    const ElasticBody<2> body(triangulation, soft_solid(degree, MaterialModel::linear, 0.));
    const auto &face = body.friction_face();
    std::map<double, double> areas;
    for (const auto &point : face.points)
      for (const auto &[node, shape] : point.nodes)
        areas[face.nodes[node].position[0]] += point.weight * shape / width;
    const std::vector<double> expected = degree == 1 ? std::vector<double>{ 0.25, 0.8, 0.55 }
                                                     : std::vector<double>{ 0.5 / 6., 2. / 6., 1.6 / 6., 4.4 / 6., 1.1 / 6. };
    ASSERT_EQ(areas.size(), expected.size());
    auto found = areas.begin();
    for (const double area : expected)
      EXPECT_NEAR((found++)->second, area, 1e-15);
  }
}

TEST(ElasticBody, CellsOfTheHubDoNotMove)
{
  dealii::Triangulation<2> triangulation;
  make_block({ 0., 1., 2., 3. }, { 0., 1. }, triangulation);
  for (const auto &cell : triangulation.active_cell_iterators())
    for (const auto &face : cell->face_iterators())
    {
      if (face->at_boundary() && face->boundary_id() == boundary_id::hub)
        face->set_boundary_id(0);
      if (cell->center()[0] < 1.)
      {
        cell->set_material_id(material_id::hub);
        if (face->at_boundary())
          face->set_boundary_id(0);
      }
    }
  const ElasticBody<2> body(triangulation, soft_solid(1, MaterialModel::linear, 0.3));
  // The hub holds the first two of the four nodes on the lower side.
  EXPECT_EQ(body.friction_face().nodes.size(), 2u);
  EXPECT_EQ(body.friction_face().elements.size(), 2u);
  Matrix matrix;
  body.reinit(matrix);
  Vector forces(body.n_dofs());
  body.assemble(Vector(body.n_dofs()), matrix, forces);
  unsigned int held = 0;
  for (unsigned int i = 0; i < body.n_dofs(); ++i)
  {
    bool couples = false;
    for (auto entry = matrix.begin(i); entry != matrix.end(i); ++entry)
      couples = couples || (entry->column() != i && entry->value() != 0.);
    held += couples ? 0 : 1;
  }
  EXPECT_EQ(held, 8u);
}
