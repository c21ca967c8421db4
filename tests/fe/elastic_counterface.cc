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
  FaceContact<2> contact((*bodies).friction_face(), properties, (*bodies).cylinder_face());
  expect_tangent_parts(contact, pressed(*bodies, properties.layout, 2e-4, 0., 0.3), 1e-8);
}

TEST(ElasticCounterface, ForcesOnLeverAndCylinderAreEqualAndOpposite)
{
  const MeshedPair bodies;
  const auto properties = make_properties(*bodies, false, 0.);
  FaceContact<2> contact((*bodies).friction_face(), properties, (*bodies).cylinder_face());
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

TEST(ElasticCounterface, RefusesAContactBeyondTheCylindersFace)
{
  const MeshedPair bodies;
  const auto properties = make_properties(*bodies, false, 0.);
  FaceContact<2> contact((*bodies).friction_face(), properties, (*bodies).cylinder_face());
  FaceEvaluation<2> found;
  Vector displacements(properties.layout.size());
  const auto n_lever = static_cast<unsigned int>((*bodies).friction_face().nodes.size());
  for (unsigned int i = 0; i < n_lever; ++i)
    displacements[2 * i + 1] = -0.3;
  contact.evaluate_sliding({ displacements, { 0., 0., 100. }, 100. }, found);
  EXPECT_THROW(found.history(), AnalysisError);
}
