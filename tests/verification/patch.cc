// SPDX-License-Identifier: GPL-3.0-only
#include "fe/contact/augmentation.h"
#include "fe/contact/face_contact.h"
#include "mpi_environment.h"
#include "scene/scene.h"
#include "two_blocks.h"

#include <deal.II/dofs/dof_tools.h>

using namespace sprag;

namespace
{
  const double modulus = 2.;
  const double height  = 2.;

  struct Outcome
  {
    FaceProfile face;
    Row row;
  };

  struct Elements
  {
    unsigned int degree;
    Enforcement enforcement;
    double penalty; ///< [N/mm^3]
    Solution solution = Solution::automatic;
  };

  /// In three steps to x = 0.1 mm.
  Outcome pressed(const dealii::Triangulation<2> &triangulation, LeverProperties properties, const Elements &elements)
  {
    const auto &[degree, enforcement, penalty, solution] = elements;
    const ElasticConstants elastic{ modulus, 0. };
    properties.solution                      = solution;
    properties.body.degree                   = degree;
    properties.body.width                    = 5.;
    properties.body.constants                = { { material_id::lever, elastic },
                                                 { material_id::layer, elastic },
                                                 { material_id::cylinder, elastic } };
    properties.contact.enforcement           = enforcement;
    properties.contact.penalty               = penalty;
    properties.contact.penetration_tolerance = 1e-10;
    StaticLever<2> model(triangulation, properties);
    Equilibrium at{ model.initial_state({ 0., 0., 1. }), {} };
    for (const double x : { 0.03, 0.06, 0.1 })
      at = step_to(model, at.state, x, properties.contact);
    Outcome outcome{ profile(model, at), {} };
    model.observe(at.state, at.found, outcome.row);
    EXPECT_EQ(outcome.face.pressure.size(), model.face_points().xi.size());
    return outcome;
  }

  /// Two blocks of half the height whose cells do not match, pressed together by 0.1 mm.
  Outcome pressed_together(const Elements &elements)
  {
    dealii::Triangulation<2> triangulation;
    make_two_blocks({ { 0., 0.35, 0.6, 1.3, 1.5, 2.4, 3. }, { 0., 0.4, 1. }, 0. },
                    { { 0., 0.5, 0.9, 1.4, 1.9, 3. }, { -1., -0.7, 0. }, 0. }, triangulation);
    return pressed(triangulation, two_block_properties(0.3), elements);
  }

  void expect_uniform(const Outcome &outcome, const double pressure)
  {
    for (const double p : outcome.face.pressure)
      EXPECT_NEAR(p, pressure, 1e-8);
    for (const double t : outcome.face.traction)
      EXPECT_NEAR(t, 0., 1e-8);
    EXPECT_NEAR(outcome.row[Column::P], pressure * 3. * 5., 1e-7);
    EXPECT_NEAR(outcome.row[Column::s], 1.5, 1e-7);
    EXPECT_NEAR(outcome.row[Column::contact_width], 3., 0.02);
  }
} // namespace

// A uniform state is among what the elements can represent: the pressure is E U / H = 0.1 MPa but for the penetration of 1e-10
// mm. By penalty, blocks and penalty are springs in series: U / (H / E + 1 / eps).
TEST(Patch, TwoElasticBlocksOfOtherCellsCarryAUniformPressure)
{
  for (const auto solution : { Solution::automatic, Solution::general })
    for (const unsigned int degree : { 1u, 2u })
    {
      for (const double penalty : { 20., 200. })
        expect_uniform(pressed_together({ degree, Enforcement::augmented_lagrangian, penalty, solution }), 0.1);
      for (const double penalty : { 2., 20., 2000. })
        expect_uniform(pressed_together({ degree, Enforcement::penalty, penalty, solution }),
                       0.1 / (height / modulus + 1. / penalty));
    }
}

// Both sides follow a parabola, which a uniform shrinkage by p / (2 lambda + 2 mu) under hydrostatic pressure p makes another
// one: with p as the multiplier no point is penetrated and every node of both sides is in balance. Free corners of the sides
// apart.
TEST(Patch, HydrostaticPressureBalancesAcrossACurvedInterface)
{
  const double bend = 0.08, pressure = 0.3, width = 5.;
  const ElasticConstants elastic{ 50., 0.2 };
  const Lame lame = plane_constants(elastic, PlaneState::strain);
  dealii::Triangulation<2> triangulation;
  make_two_blocks({ { -2., -1.5, -1.1, -0.2, 0.3, 1.2, 2. }, { 0., 0.4, 1. }, bend },
                  { { -2., -1.4, -0.6, 0.1, 0.7, 1.5, 2. }, { -1., -0.7, 0. }, bend }, triangulation);
  auto properties           = two_block_properties(0.3);
  properties.body.width     = width;
  properties.body.constants = { { material_id::lever, elastic }, { material_id::cylinder, elastic } };
  const ElasticBody<2> body(triangulation, properties.body);

  // Compliance of the whole body, and of the interface.
  dealii::Vector<double> u(body.n_dofs()), internal(body.n_dofs());
  const double shrinkage = pressure / (2. * lame.lambda + 2. * lame.mu);
  std::vector<dealii::Point<2>> support(body.n_dofs());
  dealii::DoFTools::map_dofs_to_support_points(body.cell_mapping(), body.dofs(), support);
  for (const auto &cell : body.dofs().active_cell_iterators())
  {
    std::vector<dealii::types::global_dof_index> dofs(body.dofs().get_fe().n_dofs_per_cell());
    cell->get_dof_indices(dofs);
    for (unsigned int i = 0; i < dofs.size(); ++i)
      u[dofs[i]] = -shrinkage * support[dofs[i]][body.dofs().get_fe().system_to_component_index(i).first];
  }
  dealii::PETScWrappers::SparseMatrix stiffness;
  body.reinit(stiffness);
  body.assemble(u, stiffness, internal);
  const auto dofs = surface_dofs(body);
  const InterfaceLayout layout{ static_cast<unsigned int>(dofs.size()), false };
  dealii::Vector<double> z(layout.size());
  for (unsigned int i = 0; i < dofs.size(); ++i)
    z[i] = u[dofs[i]];

  FaceContact<2> contact(body.friction_face(),
                         { properties.centre, 0., layout, properties.spring.rest, { 100., 100. }, properties.friction },
                         body.cylinder_face());
  std::vector<ContactHistory> history(body.friction_face().points.size());
  for (unsigned int q = 0; q < history.size(); ++q)
  {
    history[q].normal_multiplier = pressure;
    history[q].point             = q;
  }
  const DrivePoint rest{ 0., 0., 0. };
  FaceEvaluation<2> found;
  contact.evaluate({ rest, history, rest, { z, {}, {} }, z, {}, { 0., 0., 0., 0., 0. } }, found,
                   StaticTerms{ properties.friction, 1., FrictionMode::cone, true });
  for (const auto &point : found.points)
    EXPECT_GT(point.gap, -1e-12);
  EXPECT_EQ(found.points.size(), body.friction_face().points.size());
  const auto &forces     = found.forces;
  unsigned int n_checked = 0;
  for (unsigned int i = 0; i < forces.dofs.size() && forces.dofs[i] < layout.surface; ++i)
  {
    const unsigned int dof = dofs[forces.dofs[i]];
    if (std::abs(support[dof][0]) > 1.99)
      continue;
    EXPECT_NEAR(forces.values[i], internal[dof], 1e-11 * pressure * width) << support[dof];
    ++n_checked;
  }
  // All nodes of six edges each, two coordinates, without corners.
  EXPECT_EQ(n_checked, 2u * 2u * 11u);

  const auto multipliers = FaceMultipliers<2>(body.friction_face()).augmented(found.points);
  EXPECT_EQ(multipliers.size(), found.points.size());
  for (const auto &multiplier : multipliers)
  {
    EXPECT_NEAR(multiplier.normal_multiplier, pressure, 1e-8);
    EXPECT_NEAR(multiplier.traction[0], 0., 1e-12);
  }
}
