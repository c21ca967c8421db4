#include "fe/mesh/mesh.h"
#include "fe/solid/solid_body.h"
#include "mpi_environment.h"
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
} // namespace

// Between sections that are more than a width from both ends the held end and the way in which the couple acts do not matter.
TEST(SolidTorsion, ABarTwistsAsSaintVenantSays)
{
  Scene scene                = model_a();
  scene.lever.width          = width;
  scene.mesh.elements_across = 8;
  scene.cylinder.tilt        = 1e-12; // the whole width
  scene.lever.young_modulus  = 70000.;
  scene.lever.poisson_ratio  = 0.33;
  Mesh plane;
  make_bar(plane);
  const SolidBody body(scene, plane, MPI_COMM_SELF);

  std::vector<double> displacement(body.n_dofs(), 0.);
  double couple = 0.;
  for (const auto &node : section(body, length))
  {
    displacement[node.dof_eta]  = -node.zeta;
    displacement[node.dof_zeta] = node.eta;
    couple += node.eta * node.eta + node.zeta * node.zeta;
  }
  body.respond(displacement);
  const double rate      = (turn(body, displacement, 60.) - turn(body, displacement, 30.)) / 30.;
  const double stiffness = 70000. / 2.66 * torsion_constant(width, depth);
  EXPECT_NEAR(couple / rate, stiffness, 1e-3 * stiffness);
  EXPECT_GT(couple / rate, stiffness); // finite elements are too stiff
}
