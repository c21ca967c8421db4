// SPDX-License-Identifier: GPL-3.0-only
#include "fe/fields/body_fields.h"

#include "bar.h"
#include "fe/leaf/leaf_body.h"
#include "leaf_beam.h"
#include "mpi_environment.h"

#include <deal.II/numerics/vector_tools.h>

#include <cmath>
#include <gtest/gtest.h>

using namespace sprag;

namespace
{
  constexpr double along = 1e-3, across = -4e-4;

  struct Stretch : dealii::Function<2>
  {
    Stretch()
        : dealii::Function<2>(2)
    {
    }
    double value(const dealii::Point<2> &p, const unsigned int component) const override
    {
      return component == 0 ? along * p[0] : across * p[1];
    }
  };

  /// A bar of steel-like metal on a soft layer, both stretched along xi and across eta by strains that are the same everywhere.
  struct StretchedBar
  {
    StretchedBar()
        : body((make_bar(bar, triangulation), triangulation), bar_properties({}, 0.3))
        , displacement(body.n_dofs())
    {
      dealii::VectorTools::interpolate(body.cell_mapping(), body.dofs(), Stretch(), displacement);
    }

    Bar bar;
    dealii::Triangulation<2> triangulation;
    ElasticBody<2> body;
    dealii::Vector<double> displacement;
  };

  /// Returns the stress of plane stress, computed by hand.
  double stress_along(const double modulus, const double nu)
  {
    return modulus / (1. - nu * nu) * (along + nu * across);
  }
  double stress_across(const double modulus, const double nu)
  {
    return modulus / (1. - nu * nu) * (across + nu * along);
  }
} // namespace

TEST(BodyFields, EachPartHasItsOwnStressUpToWhereItMeetsAnother)
{
  const StretchedBar stretched;
  const BodyFields fields(stretched.body);
  const auto nodal       = fields.at(stretched.displacement);
  const double interface = stretched.bar.offset + stretched.bar.layer;
  unsigned int n_layer = 0, at_interface = 0, at_hub = 0;
  for (unsigned int i = 0; i < nodal.size(); ++i)
  {
    const auto &node = fields.nodes[i];
    const bool layer = node.part == material_id::layer;
    n_layer += layer ? 1 : 0;
    at_hub += node.at_hub ? 1 : 0;
    at_interface += std::abs(node.position[1] - interface) < 1e-9 ? 1 : 0;
    const double modulus = layer ? 20. : 70000., nu = layer ? 0. : 0.3;
    const double a = stress_along(modulus, nu), b = stress_across(modulus, nu);
    EXPECT_NEAR(nodal[i].stress[0][0], a, 1e-9 * modulus);
    EXPECT_NEAR(nodal[i].stress[1][1], b, 1e-9 * modulus);
    EXPECT_NEAR(von_mises(nodal[i]), std::sqrt(a * a - a * b + b * b), 1e-9 * modulus);
    EXPECT_NEAR(nodal[i].displacement[0], along * node.position[0], 1e-12);
    EXPECT_NEAR(nodal[i].displacement[1], across * node.position[1], 1e-12);
  }
  // 8 elements along, 1 + 2 across, one row of which is at the hub and has nodes of its own.
  EXPECT_EQ(n_layer, (3u + 15) * 3);
  EXPECT_EQ(at_interface, 2u * (3 + 15));
  EXPECT_EQ(at_hub, 3u * (3 + 5));
  EXPECT_EQ(nodal.size(), (3u + 15) * (3 + 5));
  EXPECT_EQ(fields.elements.size(), 9u * 8 * 3);
  EXPECT_EQ(fields.element_cells.size(), 4u * 4);
  double area = 0.;
  for (unsigned int first = 0; first < fields.elements.size(); first += fields.nodes_per_element)
    for (unsigned int q = 0; q < fields.element_cells.size(); q += 4)
    {
      const auto corner = [&](const unsigned int c)
      { return fields.nodes[fields.elements[first + fields.element_cells[q + c]]].position; };
      for (unsigned int c = 0; c < 4; ++c)
        area += 0.5 * (corner(c)[0] * corner((c + 1) % 4)[1] - corner((c + 1) % 4)[0] * corner(c)[1]);
    }
  EXPECT_NEAR(area, 20. * 2.5, 1e-9);
}

namespace
{
  constexpr double cubic = 1e-5;

  /// Strain cubic p_x^2 along.
  struct Cubic : dealii::Function<2>
  {
    Cubic()
        : dealii::Function<2>(2)
    {
    }
    double value(const dealii::Point<2> &p, const unsigned int component) const override
    {
      return component == 0 ? cubic * p[0] * p[0] * p[0] / 3. : 0.;
    }
  };
} // namespace

/// At the Gauss points of a cell of length h the strain a x^2 is exact; the line through them is off by a (2/3)(h/2)^2 at the
/// cell's ends, on both sides alike. Strains evaluated there would be off by twice that.
TEST(BodyFields, StressIsContinuedFromTheGaussPointsAndMeetsItsNeighbour)
{
  Bar bar;
  dealii::Triangulation<2> triangulation;
  make_bar(bar, triangulation);
  const ElasticBody<2> body(triangulation, bar_properties({}, 0.));
  dealii::Vector<double> displacement(body.n_dofs());
  dealii::VectorTools::interpolate(body.cell_mapping(), body.dofs(), Cubic(), displacement);
  const BodyFields fields(body);
  const auto nodal = fields.at(displacement);
  const double h   = 20. / 8.;
  for (unsigned int i = 0; i < nodal.size(); ++i)
  {
    const auto &node     = fields.nodes[i];
    const double modulus = node.part == material_id::layer ? 20. : 70000.;
    const double x       = node.position[0];
    const bool is_end    = std::abs(std::remainder(x, h)) < 1e-9;
    const double half    = 0.5 * h;
    const double error   = (is_end ? -2. : 1.) / 3. * half * half;
    EXPECT_NEAR(nodal[i].stress[0][0] / modulus, cubic * (x * x + error), 1e-12) << x;
  }
}

// A guided leaf bends to an arc of the angle by which its hub turns: E t/2 angle/L at its surfaces, whatever the rotation. The
// stress of the solid differs from that of a beam by about the strain itself. Parabolas in place of the arc stretch by up to
// beta^2/24, beta the angle over an element, the longest of which is 1.7 times the mean one (the grading of meshes/leaf.geo).
TEST(BodyFields, StressOfATurnedLeafIsThatOfBending)
{
  LeafSpring leaf;
  leaf.end           = LeafEnd::guided;
  leaf.poisson_ratio = 0.;
  LeafBody body(leaf, PlaneState::stress);
  const double turn = 0.2;
  const auto state  = body.steps(body.rest(), turn).back();
  const BodyFields fields(body.body());
  const auto nodal    = fields.at(state.displacement);
  const double strain = 0.5 * leaf.thickness * turn / leaf.length;
  const double beta   = 1.7 * turn / leaf_elements(leaf).along;
  unsigned int found  = 0;
  for (unsigned int i = 0; i < nodal.size(); ++i)
    if (std::abs(std::abs(fields.nodes[i].position[1]) - 0.5 * leaf.thickness) < 1e-5)
    {
      EXPECT_NEAR(von_mises(nodal[i]), leaf.young_modulus * strain,
                  leaf.young_modulus * (2. * strain * strain + beta * beta / 24.))
          << "at " << fields.nodes[i].position[0];
      ++found;
    }
  EXPECT_GE(found, 4 * leaf_elements(leaf).along);
}
