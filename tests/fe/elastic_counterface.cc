// SPDX-License-Identifier: GPL-3.0-only
#include "fe/contact/face_contact.h"

#include "bar_on_elastic_cylinder.h"
#include "base/errors.h"
#include "mpi_environment.h"
#include "pressed_step.h"
#include "support/interface_differences.h"

#include <gtest/gtest.h>

using namespace sprag;

namespace
{
  using Vector = dealii::Vector<double>;
} // namespace

// The tangent neglects the kink between the cylinder's edges times the gap: 1e-9 of it.
TEST(ElasticCounterface, PartsAddUpToTheTangentAndPressureIsSymmetric)
{
  const MeshedPair bodies;
  const auto properties = make_properties(*bodies, true, 0.);
  FaceContact contact(*bodies, properties);
  expect_tangent_parts(contact, pressed(*bodies, properties.layout, 2e-4, 0., 0.3), 1e-8);
}

TEST(ElasticCounterface, ForcesOnLeverAndCylinderAreEqualAndOpposite)
{
  const MeshedPair bodies;
  const auto properties = make_properties(*bodies, false, 0.);
  FaceContact contact(*bodies, properties);
  FaceEvaluation<2> found;
  const PressedStep step(contact, *bodies, properties.layout, 2e-4, 1.01);
  contact.evaluate(*step, found);
  const auto n_lever = 2 * static_cast<unsigned int>((*bodies).friction_face().nodes.size());
  dealii::Tensor<1, 2> on_lever, on_cylinder;
  for (unsigned int a = 0; a + 1 < found.forces.dofs.size(); ++a)
  {
    const unsigned int dof = found.forces.dofs[a];
    (dof < n_lever ? on_lever : on_cylinder)[dof % 2] += found.forces.values[a];
  }
  EXPECT_GT(on_lever[1], 1.);
  EXPECT_NEAR((on_lever + on_cylinder).norm(), 0., 1e-12 * on_lever.norm());
}

// Facets of 0.025 mm average where the circle's points sample: the force differs where the contact ends, by a facet's share of a
// half width of some 0.35 mm, squared.
TEST(ElasticCounterface, AnUndeformedCylinderIsARigidOne)
{
  const MeshedPair bodies;
  const auto properties = make_properties(*bodies, false, 0.);
  const MeshedBar bar(bar_on_cylinder());
  const auto rigid_properties = make_properties(*bar, false, 0.);
  FaceContact contact(*bodies, properties);
  FaceEvaluation<2> found;
  FaceContact rigid(*bar, rigid_properties);
  FaceEvaluation<2> rigid_evaluation;
  for (const double speed : { 100., -100. })
  {
    Vector displacements(properties.layout.size()), rigid_displacements(rigid_properties.layout.size());
    for (unsigned int i = 0; i < rigid_properties.layout.surface; ++i)
      displacements[i] = rigid_displacements[i] = i % 2 == 1 ? -0.01 : 0.;
    const DrivePoint drive{ 0., 0., speed };
    contact.evaluate_sliding({ displacements, drive, speed }, found);
    rigid.evaluate_sliding({ rigid_displacements, drive, speed }, rigid_evaluation);
    Row row, circle_row;
    contact.observe(found, row);
    rigid.observe(rigid_evaluation, circle_row);
    for (const auto column : { Column::P, Column::F, Column::Q, Column::normal_resultant, Column::friction_resultant })
      EXPECT_NEAR(row[column], circle_row[column], 5e-3 * circle_row[Column::P]) << speed;
    EXPECT_NEAR(row[Column::F] / row[Column::P], circle_row[Column::F] / circle_row[Column::P], 1e-4);
    EXPECT_NEAR(row[Column::s], circle_row[Column::s], 1e-3);
    EXPECT_NEAR(found.energy(), rigid_evaluation.energy(), 1e-2 * rigid_evaluation.energy());
    const double h = 1e-4;
    EXPECT_NEAR(contact.mean_slip(found, displacements, 0., displacements, h),
                rigid.mean_slip(rigid_evaluation, rigid_displacements, 0., rigid_displacements, h), 5e-5 * h);
    Vector change(displacements.size()), rigid_change(rigid_displacements.size());
    change[properties.layout.rotation()] = rigid_change[rigid_properties.layout.rotation()] = 1e-6;
    EXPECT_NEAR(contact.gap_change(found, change), rigid.gap_change(rigid_evaluation, rigid_change), 1e-8);
  }
}

TEST(ElasticCounterface, RefusesAContactBeyondTheCylindersFace)
{
  const MeshedPair bodies;
  const auto properties = make_properties(*bodies, false, 0.);
  FaceContact contact(*bodies, properties);
  FaceEvaluation<2> found;
  Vector displacements(properties.layout.size());
  const auto n_lever = static_cast<unsigned int>((*bodies).friction_face().nodes.size());
  for (unsigned int i = 0; i < n_lever; ++i)
    displacements[2 * i + 1] = -0.3;
  contact.evaluate_sliding({ displacements, { 0., 0., 100. }, 100. }, found);
  EXPECT_THROW(found.history(), AnalysisError);
}
