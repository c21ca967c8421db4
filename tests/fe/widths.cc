// SPDX-License-Identifier: GPL-3.0-only
#include "bar.h"
#include "base/errors.h"
#include "fe/algebra/compressed_rows.h"
#include "mpi_environment.h"

#include <deal.II/dofs/dof_tools.h>

#include <gtest/gtest.h>

using namespace sprag;

namespace
{
  using Vector = dealii::Vector<double>;

  constexpr double young_modulus = 70000.;

  /// The bar of bar.h with its layer a web of the metal's stiffness.
  struct WebbedBar
  {
    Bar shape;
    double web_width = 1.5;
    dealii::Triangulation<2> triangulation;
    std::unique_ptr<ElasticBody<2>> body;

    explicit WebbedBar(const double poisson_ratio)
    {
      make_bar(shape, triangulation);
      for (const auto &cell : triangulation.active_cell_iterators())
        if (cell->material_id() == material_id::layer)
          cell->set_material_id(material_id::web);
      BodyProperties properties           = bar_properties(shape, poisson_ratio);
      properties.constants                = { { material_id::lever, { young_modulus, poisson_ratio } },
                                              { material_id::web, { young_modulus, poisson_ratio } } };
      properties.widths[material_id::web] = web_width;
      body                                = std::make_unique<ElasticBody<2>>(triangulation, properties);
    }

    /// Integral of the width over the section.
    double section() const
    {
      return shape.width * shape.depth + web_width * shape.layer;
    }
  };

  std::vector<dealii::Point<2>> positions(const ElasticBody<2> &body)
  {
    std::vector<dealii::Point<2>> result(body.n_dofs());
    dealii::DoFTools::map_dofs_to_support_points(body.cell_mapping(), body.dofs(), result);
    return result;
  }
} // namespace

TEST(Widths, UniformTensionIsHeldByBothWidths)
{
  const WebbedBar bar(0.);
  const double strain = 1e-3;
  const auto places   = positions(*bar.body);
  const auto axis     = dealii::DoFTools::extract_dofs(bar.body->dofs(), dealii::ComponentMask(std::vector<bool>{ true, false }));
  Vector u(bar.body->n_dofs()), forces(bar.body->n_dofs());
  for (unsigned int i = 0; i < u.size(); ++i)
    u[i] = axis.is_element(i) ? strain * places[i][0] : 0.;
  dealii::PETScWrappers::SparseMatrix stiffness;
  bar.body->reinit(stiffness);
  bar.body->assemble(u, stiffness, forces);
  // Uniform stress: nothing inside, E strain times the section at the end.
  const double tension = young_modulus * strain * bar.section();
  double at_end        = 0.;
  for (unsigned int i = 0; i < u.size(); ++i)
    if (places[i][0] > bar.shape.length - 1e-9)
      at_end += axis.is_element(i) ? forces[i] : 0.;
    else
      EXPECT_NEAR(forces[i], 0., 1e-12 * tension);
  EXPECT_NEAR(at_end, tension, 1e-12 * tension);
  const double energy = 0.5 * tension * strain * bar.shape.length;
  EXPECT_NEAR(bar.body->energy(u), energy, 1e-12 * energy);
  const auto in_time = InertialMatrices(
      *bar.body, { { { material_id::lever, 1e-9 }, { material_id::web, 1e-9 } }, 0., 0., InertiaSource::as_built, 0., {} });
  Vector total(in_time.coordinates.size()), product(in_time.coordinates.size());
  for (unsigned int i = 0; i < u.size(); ++i)
    if (!bar.body->is_held(i))
      total[in_time.coordinates.mover(i).coordinate] = u[i];
  CompressedRows(in_time.stiffness).multiply<1>({ { &total } }, { { &product } });
  EXPECT_NEAR(0.5 * (total * product), energy, 1e-12 * energy);
}

TEST(Widths, AsBuiltTheInertiaIsThatOfTheMaterial)
{
  const WebbedBar bar(0.3);
  const auto &s = bar.shape;
  LeverInertia inertia;
  inertia.densities         = { { material_id::lever, 2.7e-9 }, { material_id::web, 2.7e-9 } };
  inertia.moment_of_inertia = 123.;
  inertia.hub               = 2e-4;
  inertia.source            = InertiaSource::as_built;
  const InertialMatrices matrices(*bar.body, inertia);
  const auto strip_part = [&](const double from, const double to, const double width)
  { return 2.7e-9 * width * s.length * (to - from) * (s.length * s.length + from * from + from * to + to * to) / 3.; };
  const double middle   = s.offset + s.layer;
  const double expected = strip_part(s.offset, middle, bar.web_width) + strip_part(middle, middle + s.depth, s.width) + 2e-4;
  EXPECT_EQ(matrices.density_factor, 1.);
  EXPECT_NEAR(matrices.moment_of_inertia, expected, 1e-12 * expected);
  EXPECT_NEAR(matrices.total_mass, 2.7e-9 * s.length * bar.section(), 1e-12 * matrices.total_mass);
  const auto turned = matrices.coordinates.rigid_rotation();
  Vector product(turned.size());
  CompressedRows(matrices.mass).multiply<1>({ { &turned } }, { { &product } });
  EXPECT_NEAR(turned * product, expected, 1e-12 * expected);
}
