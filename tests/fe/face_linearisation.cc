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

  InterfaceForces compute_forces(const FaceContact &contact, const SlidingState &state)
  {
    FaceEvaluation<2> found;
    contact.evaluate_sliding(state, found);
    return found.forces;
  }
} // namespace

// A step from the slide, all weight on its end: at every point the return to the cone of stick is Euler's backward rule for the
// delay, (1 + time/dt) tau = stiffness_row . z + rate_row . z/dt. Over 2e-6 mm points of 1e-6 mm come and go.
TEST(FaceLinearisation, FrictionThatGrowsWithSpeedIsDelayedAsInSteps)
{
  const MeshedBar bar(bar_on_cylinder());
  for (const bool sprung : { false, true })
    for (const double speed : { 100., -100. })
      for (const double dt : { 1e-5, 1e-4 })
      {
        const auto properties = make_properties(*bar, sprung, 0.);
        FaceContact contact(*bar, properties);
        FaceEvaluation<2> found;
        const Vector at   = pressed(properties.layout, 0.01);
        const auto linear = contact.linearise({ at, { 0., 0., speed, 0. }, speed }, found);
        ASSERT_GT(linear.delays.size(), 10u);
        Motion accepted;
        accepted.contact = found.history();
        Full exact       = linear.immediate_stiffness();
        exact.add(1. / dt, linear.immediate_damping());
        double longest = 0.;
        for (const auto &delay : linear.delays)
        {
          longest = std::max(longest, delay.time);
          for (unsigned int i = 0; i < exact.m(); ++i)
            for (unsigned int j = 0; j < exact.n(); ++j)
              exact(i, j) += delay.force[i] * (delay.stiffness_row[j] + delay.rate_row[j] / dt) / (1. + delay.time / dt);
        }
        EXPECT_GT(longest, 1e-5);
        const Vector rest(at.size());
        const Kinematic begin{ at, rest, rest };
        const DrivePoint to{ dt, 0., 0., 0., speed * dt };
        const auto moved = [&](const unsigned int dof, const double by)
        {
          Vector end = at, rate(at.size());
          end[dof] += by;
          rate[dof] = by / dt;
          contact.evaluate(InterfaceStep{ accepted.drive, accepted.contact, to, begin, end, rate, { dt, 0., 0., 0.25, 0.5 } },
                           found);
          return found.forces;
        };
        const double largest = exact.linfty_norm();
        for (unsigned int j = 0; j < linear.dofs.size(); ++j)
        {
          const double h   = 2e-6 / (linear.dofs[j] == properties.layout.rotation() ? 12. : 1.);
          const auto right = moved(linear.dofs[j], h);
          const auto left  = moved(linear.dofs[j], -h);
          ASSERT_EQ(right.dofs, linear.dofs);
          for (unsigned int i = 0; i < linear.dofs.size(); ++i)
            EXPECT_NEAR(exact(i, j), (right.values[i] - left.values[i]) / (2. * h), 1e-5 * largest) << sprung << i << " " << j;
        }
      }
}

// A step without movement, all weight on its end, that begins without friction.
TEST(FaceLinearisation, StuckIsTheTangentOfAStepInStick)
{
  const MeshedBar bar(bar_on_cylinder());
  for (const bool sprung : { false, true })
  {
    const auto properties = make_properties(*bar, sprung, 0.);
    FaceContact contact(*bar, properties);
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
  FaceContact contact(*bar, properties);
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
  FaceContact contact(*bar, properties);
  expect_tangent_parts(contact, pressed(properties.layout, 0.01), 1e-14);
}
