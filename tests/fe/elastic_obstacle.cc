// SPDX-License-Identifier: GPL-3.0-only
#include "fe/contact/face_contact.h"

#include "bar_on_elastic_cylinder.h"
#include "base/errors.h"
#include "mpi_environment.h"
#include "pressed_step.h"
#include "support/port_differences.h"

#include <gtest/gtest.h>

using namespace sprag;

namespace
{
  using Vector = dealii::Vector<double>;
} // namespace

// Where the cylinder's edges meet, what their kink times the gap moves is left out: 1e-9 of the tangent.
TEST(ElasticObstacle, PartsAddUpToTheTangentAndPressureIsSymmetric)
{
  const MeshedPair bodies;
  const auto properties = properties_of(*bodies, true, 0.);
  FaceContact contact(*bodies, properties);
  expect_parts_of_tangent(contact, pressed(*bodies, properties.ports, 2e-4, 0., 0.3), 1e-8);
}

TEST(ElasticObstacle, ForcesOnLeverAndCylinderAreEqualAndOpposite)
{
  const MeshedPair bodies;
  const auto properties = properties_of(*bodies, false, 0.);
  FaceContact contact(*bodies, properties);
  FaceEvaluation<2> found;
  const PressedStep step(contact, *bodies, properties.ports, 2e-4, 1.01);
  contact.evaluate(*step, found);
  const auto n_lever = 2 * static_cast<unsigned int>((*bodies).friction_face().nodes.size());
  dealii::Tensor<1, 2> on_lever, on_cylinder;
  for (unsigned int a = 0; a + 1 < found.forces.ports.size(); ++a)
  {
    const unsigned int port = found.forces.ports[a];
    (port < n_lever ? on_lever : on_cylinder)[port % 2] += found.forces.values[a];
  }
  EXPECT_GT(on_lever[1], 1.);
  EXPECT_NEAR((on_lever + on_cylinder).norm(), 0., 1e-12 * on_lever.norm());
}

// Facets of 0.025 mm average where the circle's points sample: the force differs where the contact ends, by a facet's share of a
// half width of some 0.35 mm, squared.
TEST(ElasticObstacle, AnUndeformedCylinderIsARigidOne)
{
  const MeshedPair bodies;
  const auto properties = properties_of(*bodies, false, 0.);
  const MeshedBar bar(bar_on_cylinder());
  const auto rigid_properties = properties_of(*bar, false, 0.);
  FaceContact contact(*bodies, properties);
  FaceEvaluation<2> found;
  FaceContact rigid(*bar, rigid_properties);
  FaceEvaluation<2> found_of_rigid;
  for (const double speed : { 100., -100. })
  {
    Vector ports(properties.ports.size()), of_rigid(rigid_properties.ports.size());
    for (unsigned int i = 0; i < rigid_properties.ports.surface; ++i)
      ports[i] = of_rigid[i] = i % 2 == 1 ? -0.01 : 0.;
    const DrivePoint drive{ 0., 0., speed };
    contact.evaluate_sliding({ ports, drive, speed }, found);
    rigid.evaluate_sliding({ of_rigid, drive, speed }, found_of_rigid);
    Row row, of_circle;
    contact.observe(found, row);
    rigid.observe(found_of_rigid, of_circle);
    for (const auto column : { Column::P, Column::F, Column::Q, Column::normal_resultant, Column::friction_resultant })
      EXPECT_NEAR(row[column], of_circle[column], 5e-3 * of_circle[Column::P]) << speed;
    EXPECT_NEAR(row[Column::F] / row[Column::P], of_circle[Column::F] / of_circle[Column::P], 1e-4);
    EXPECT_NEAR(row[Column::s], of_circle[Column::s], 1e-3);
    EXPECT_NEAR(found.energy(), found_of_rigid.energy(), 1e-2 * found_of_rigid.energy());
    const double h = 1e-4;
    EXPECT_NEAR(contact.mean_slip(found, ports, 0., ports, h), rigid.mean_slip(found_of_rigid, of_rigid, 0., of_rigid, h),
                5e-5 * h);
    Vector change(ports.size()), of_lever(of_rigid.size());
    change[properties.ports.rotation()] = of_lever[rigid_properties.ports.rotation()] = 1e-6;
    EXPECT_NEAR(contact.gap_change(found, change), rigid.gap_change(found_of_rigid, of_lever), 1e-8);
  }
}

TEST(ElasticObstacle, RefusesAContactBeyondTheCylindersFace)
{
  const MeshedPair bodies;
  const auto properties = properties_of(*bodies, false, 0.);
  FaceContact contact(*bodies, properties);
  FaceEvaluation<2> found;
  Vector ports(properties.ports.size());
  const auto n_lever = static_cast<unsigned int>((*bodies).friction_face().nodes.size());
  for (unsigned int i = 0; i < n_lever; ++i)
    ports[2 * i + 1] = -0.3;
  contact.evaluate_sliding({ ports, { 0., 0., 100. }, 100. }, found);
  EXPECT_THROW(found.memory(), AnalysisError);
}
