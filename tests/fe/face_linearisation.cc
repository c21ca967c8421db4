// SPDX-License-Identifier: GPL-3.0-only
#include "fe/contact/face_contact.h"

#include "bar_on_cylinder.h"
#include "mpi_environment.h"
#include "support/interface_differences.h"

#include <gtest/gtest.h>

using namespace sprag;

namespace
{
  using Vector = dealii::Vector<double>;
  using Full   = dealii::FullMatrix<double>;

  /// The face moved down by `depth` [mm], uneven by micrometres.
  Vector pressed(const InterfaceLayout &layout, const double depth)
  {
    Vector result(layout.size());
    for (unsigned int i = 0; i < layout.surface; ++i)
      result[i] = 1e-3 * std::sin(1.7 * i) - (i % 2 == 1 ? depth : 0.);
    return result;
  }

  InterfaceForces compute_forces(FaceContact<2> &contact, const SlidingState &state)
  {
    FaceEvaluation<2> found;
    contact.evaluate_sliding(state, found);
    return found.forces;
  }
} // namespace

// Over 2e-6 mm points of 1e-6 mm come and go.
TEST(FaceLinearisation, FrictionThatGrowsWithSpeedIsDelayedAsInSteps)
{
  const MeshedBar bar(bar_on_cylinder());
  for (const bool sprung : { false, true })
  {
    const auto properties = make_properties(*bar, sprung, 0.);
    FaceContact<2> contact((*bar).friction_face(), properties);
    expect_delays_as_in_steps(contact, pressed(properties.layout, 0.01), 0., 1e-5,
                              [&](const unsigned int dof) { return 2e-6 / (dof == properties.layout.rotation() ? 12. : 1.); });
  }
}

// A step without movement, all weight on its end, that begins without friction.
TEST(FaceLinearisation, StuckIsTheTangentOfAStepInStick)
{
  const MeshedBar bar(bar_on_cylinder());
  for (const bool sprung : { false, true })
  {
    const auto properties = make_properties(*bar, sprung, 0.);
    FaceContact<2> contact((*bar).friction_face(), properties);
    FaceEvaluation<2> found;
    const Vector displacements = pressed(properties.layout, 0.01);
    const DrivePoint drive{ 0., 0., 0., 0. };
    const auto linear = compute_forces(contact, { displacements, drive, 100., nullptr, ContactFriction::stuck });
    const Vector rest(displacements.size());
    const StepWeights weights{ 1e-5, 0., 0., 0.25, 0.5 };
    Motion accepted;
    accepted.drive = drive;
    contact.evaluate(
        InterfaceStep{ accepted.drive, accepted.contact, drive, { displacements, rest, rest }, displacements, rest, weights },
        found);
    ASSERT_EQ(found.forces.dofs, linear.dofs);
    Full difference = found.forces.tangent;
    difference.add(-1., linear.tangent);
    EXPECT_LT(difference.frobenius_norm(), 1e-12 * linear.tangent.frobenius_norm());
    EXPECT_GT(linear.tangent.frobenius_norm(), 1.);
  }
}

TEST(FaceLinearisation, IsNothingOutOfContact)
{
  const MeshedBar bar(bar_on_cylinder());
  const auto properties = make_properties(*bar, true, 0.);
  FaceContact<2> contact((*bar).friction_face(), properties);
  FaceEvaluation<2> found;
  const Vector displacements = pressed(properties.layout, -0.1);
  const DrivePoint drive{ 0., 0., 100., 0. };
  EXPECT_TRUE(compute_forces(contact, { displacements, drive, 100. }).dofs.empty());
  EXPECT_TRUE(contact.linearise({ displacements, drive, 100. }, found).dofs.empty());
}

TEST(FaceLinearisation, PartsAddUpToTheTangentAndPressureIsSymmetric)
{
  const MeshedBar bar(bar_on_cylinder());
  const auto properties = make_properties(*bar, true, 0.);
  FaceContact<2> contact((*bar).friction_face(), properties);
  expect_tangent_parts(contact, pressed(properties.layout, 0.01), 1e-14);
}
