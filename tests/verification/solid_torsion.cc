// SPDX-License-Identifier: GPL-3.0-only
#include "fe/fields/body_fields.h"
#include "fe/mesh/lever_mesh.h"
#include "fe/statics/solid_body.h"
#include "mpi_environment.h"
#include "scene/scene.h"
#include "scenes.h"

#include <deal.II/dofs/dof_tools.h>
#include <deal.II/grid/grid_generator.h>

#include <cmath>
#include <gtest/gtest.h>

using namespace sprag;

namespace
{
  constexpr double length = 90., depth = 10., width = 20.;

  /// A bar, held at xi = 0.
  void make_bar(Mesh &mesh)
  {
    dealii::GridGenerator::subdivided_hyper_rectangle(mesh, { 27, 5 }, dealii::Point<2>(0., 0.), dealii::Point<2>(length, depth));
    for (const auto &cell : mesh.active_cell_iterators())
    {
      cell->set_material_id(material_id::lever);
      for (const auto &side : cell->face_iterators())
        if (side->at_boundary())
          side->set_boundary_id(side->center()[0] < 1e-9   ? boundary_id::hub
                                : side->center()[1] < 1e-9 ? boundary_id::friction_face
                                                           : 0);
    }
  }

  /// Saint-Venant's torsion constant of a rectangle, a >= b (Timoshenko and Goodier, section 109).
  double torsion_constant(const double a, const double b)
  {
    double sum = 0.;
    for (int n = 1; n < 40; n += 2)
      sum += std::tanh(0.5 * n * M_PI * a / b) / std::pow(n, 5);
    return a * b * b * b / 3. * (1. - 192. * b / (std::pow(M_PI, 5) * a) * sum);
  }

  /// Nodes of a cross section, seen from its middle.
  struct SectionNode
  {
    double eta, zeta;
    unsigned int dof_eta, dof_zeta;
  };

  std::vector<SectionNode> section(const SolidBody &body, const double xi)
  {
    std::vector<dealii::Point<3>> place(body.n_dofs());
    dealii::DoFTools::map_dofs_to_support_points(body.cell_mapping(), body.dofs(), place);
    std::vector<SectionNode> result;
    for (unsigned int dof = 0; dof < body.n_dofs(); dof += 3) // three follow each other at a node
      if (std::abs(place[dof][0] - xi) < 1e-6)
        result.push_back({ place[dof][1] - 0.5 * depth, place[dof][2], dof + 1, dof + 2 });
    return result;
  }

  double turn(const SolidBody &body, const std::vector<double> &displacement, const double xi)
  {
    double moved = 0., polar = 0.;
    for (const auto &node : section(body, xi))
    {
      moved += node.eta * displacement[node.dof_zeta] - node.zeta * displacement[node.dof_eta];
      polar += node.eta * node.eta + node.zeta * node.zeta;
    }
    return moved / polar;
  }

  Scene bar_scene()
  {
    Scene scene                = model_a();
    scene.lever.width          = width;
    scene.mesh.elements_across = 8;
    scene.cylinder.tilt        = 1e-12; // the whole width
    scene.lever.young_modulus  = 70000.;
    scene.lever.poisson_ratio  = 0.33;
    return scene;
  }

  struct TwistedBar
  {
    TwistedBar()
        : body((make_bar(plane), bar_scene()), plane)
        , displacement(body.n_dofs(), 0.)
    {
      for (const auto &node : section(body, length))
      {
        displacement[node.dof_eta]  = -node.zeta;
        displacement[node.dof_zeta] = node.eta;
        couple += node.eta * node.eta + node.zeta * node.zeta;
      }
      body.respond(displacement);
      rate = (turn(body, displacement, 60.) - turn(body, displacement, 30.)) / 30.;
    }

    Mesh plane;
    const SolidBody body;
    std::vector<double> displacement;
    double couple = 0.;
    double rate   = 0.; ///< of twist [rad/mm]
  };

  /// Saint-Venant's shear stress on a section of a rectangle over shear modulus and rate of twist, along eta and zeta: Prandtl's
  /// function is d^2/4 - eta^2 less the series that makes it vanish at both ends of the width.
  std::array<double, 2> torsion_shear(const double eta, const double zeta)
  {
    std::array<double, 2> result{ { 0., 2. * eta } };
    double sign = 1.;
    for (int n = 1; n < 80; n += 2, sign = -sign)
    {
      const double k      = n * M_PI / depth;
      const double factor = sign * 8. * depth * depth / std::pow(n * M_PI, 3) * k;
      // cosh and sinh over the cosh of the end, which would overflow.
      const double grown = std::exp(k * (std::abs(zeta) - 0.5 * width)), fallen = std::exp(-k * (std::abs(zeta) + 0.5 * width));
      const double whole = 1. + std::exp(-k * width);
      result[0] -= factor * std::copysign(grown - fallen, zeta) / whole * std::cos(k * eta);
      result[1] -= factor * (grown + fallen) / whole * std::sin(k * eta);
    }
    return result;
  }
} // namespace

// Between sections that are more than a width from both ends the held end and the way in which the couple acts do not matter.
TEST(SolidTorsion, ABarTwistsAsSaintVenantSays)
{
  const TwistedBar bar;
  const double stiffness = 70000. / 2.66 * torsion_constant(width, depth);
  EXPECT_NEAR(bar.couple / bar.rate, stiffness, 1e-3 * stiffness);
  EXPECT_GT(bar.couple / bar.rate, stiffness); // finite elements are too stiff
}

// Stress is continued from the Gauss points by a line through them, off by f'' h^2/12 in each direction. Towards both ends of the
// width the series is 0.8 of the largest stress times exp(-pi z/d): with elements of 2.7 by 2 mm that is off by 0.075 at the
// ends, a fifth of it a half depth from there.
TEST(SolidTorsion, ItsFieldsHaveSaintVenantsStress)
{
  const TwistedBar bar;
  const BodyFields fields(bar.body);
  const auto nodal     = fields.at(dealii::Vector<double>(bar.displacement.begin(), bar.displacement.end()));
  const double scale   = 70000. / 2.66 * bar.rate;
  const double largest = scale * torsion_shear(0.5 * depth, 0.)[1];
  unsigned int found   = 0;
  double off = 0., off_within = 0.;
  for (unsigned int i = 0; i < nodal.size(); ++i)
  {
    const auto &place = fields.nodes[i].position;
    if (place[0] < 30. - 1e-9 || place[0] > 60. + 1e-9)
      continue;
    const auto expected = torsion_shear(place[1] - 0.5 * depth, place[2]);
    const auto &stress  = nodal[i].stress;
    const double here =
        std::max({ std::abs(stress[0][1] - scale * expected[0]), std::abs(stress[0][2] - scale * expected[1]),
                   std::abs(stress[0][0]), std::abs(stress[1][1]), std::abs(stress[2][2]), std::abs(stress[1][2]) });
    off = std::max(off, here);
    if (std::abs(place[2]) <= 0.5 * (width - depth))
      off_within = std::max(off_within, here);
    ++found;
  }
  EXPECT_EQ(found, 19u * 11 * 17);
  EXPECT_GT(largest, 0.);
  EXPECT_LT(off, 0.075 * largest);
  EXPECT_LT(off_within, 0.2 * 0.075 * largest);
}
