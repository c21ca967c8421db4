// SPDX-License-Identifier: GPL-3.0-only
#include "scene/scene.h"
#include "verification/rigid_block.h"

#include <gtest/gtest.h>

using namespace sprag;

// A wedge on a guide is driven against a slope by a given force F: F = N (sin a + mu cos a), so a normal force of 5624.1 N for
// tan a = 0.115, mu = 0.2, F = 1760 N. The slope is so slight that friction carries most of the force: what the contact knows of
// its own pressure when it works out the friction decides whether the iteration ends.

namespace
{
  constexpr double slope       = 0.115;
  constexpr double coefficient = 0.2;
  constexpr double full_force  = 1760.;
  constexpr double reference   = 5624.1; ///< to the printed digits

  const double cosine = 1. / std::sqrt(1. + slope * slope);
  const double sine   = slope * cosine;

  /// One displacement, towards the slope; the force grows with the drive from 0 to all of it at x = 1.
  RigidBlock<1>::Properties wedge(const Enforcement enforcement, const double mu)
  {
    const auto load = [](const dealii::Tensor<1, 1> &, const double x)
    {
      RigidBlock<1>::Load result;
      result.force[0] = full_force * x;
      return result;
    };
    const auto contact = [](const dealii::Tensor<1, 1> &u)
    {
      ContactKinematics<1> result;
      result.gap         = -sine * u[0];
      result.gap_row[0]  = -sine;
      result.slip        = cosine * u[0];
      result.slip_row[0] = cosine;
      return result;
    };
    dealii::Tensor<1, 1> start;
    start[0] = 1e-15; // A rigid wedge must not slip back from where it first touches: friction would then leave its cone.
    return { load, contact, { CoulombFriction{ mu }, FrictionSpeed::sliding }, 1e5, enforcement, start };
  }

  std::vector<Row> loaded(const RigidBlock<1>::Properties &properties, const double step)
  {
    return run_block<1>(properties, Drive(DriveProfile::triangle, 0., 1., 1., 0.5), step);
  }
} // namespace

TEST(ForceControlledWedge, CarriesTheNormalForceOfStatics)
{
  const double exact = full_force / (sine + coefficient * cosine);
  EXPECT_NEAR(exact, reference, 0.05); // half a unit of its last digit
  for (const auto enforcement : { Enforcement::penalty, Enforcement::augmented_lagrangian })
    for (const double step : { 1., 0.1 })
    {
      const Row last = loaded(wedge(enforcement, coefficient), step).back();
      EXPECT_EQ(last[Column::x], 1.);
      // Statically determined: whatever the penetration, the forces are exact to round-off.
      EXPECT_NEAR(last[Column::P] / exact, 1., 1e-12);
      EXPECT_NEAR(last[Column::F] / (coefficient * exact), 1., 1e-12);
    }
}

TEST(ForceControlledWedge, AugmentationEndsAtOnceAndRemovesTheOverlap)
{
  const auto rows = loaded(wedge(Enforcement::augmented_lagrangian, coefficient), 0.1);
  ASSERT_GT(rows.back()[Column::x], 0.);
  for (const Row &row : rows)
    if (row[Column::x] > 0.)
    {
      EXPECT_LE(row[Column::penetration], 1e-6);
      // The pressure is right in the first solution, and the multiplier equal to it in the second.
      EXPECT_LE(row[Column::augmentations], 2.);
    }
}

TEST(ForceControlledWedge, NormalForceFollowsTheCoefficient)
{
  for (const double mu : { 0., 0.9 * coefficient, 1. })
  {
    const Row last = loaded(wedge(Enforcement::augmented_lagrangian, mu), 0.1).back();
    EXPECT_NEAR(last[Column::P] * (sine + mu * cosine) / full_force, 1., 1e-12);
  }
}
