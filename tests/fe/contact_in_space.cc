// SPDX-License-Identifier: GPL-3.0-only
#include "bed_of_springs.h"
#include "mpi_environment.h"
#include "support/interface_differences.h"
#include "support/random_vector.h"
#include "support/turning_axis.h"

#include <gtest/gtest.h>

using namespace sprag;

// P = (2/5)(c/tilt)[d^(5/2)], M = (c/tilt^2)[(2/7) d^(7/2) - (2/5) d_0 d^(5/2)] with c = 4/3 K sqrt(2 R), d = d_0 +- tilt w/2 at
// the edges, cut off at 0, K = 12.5 N/mm^3, d_0 = 0.03 mm. A parabola stands for the circle, which leaves some 2 d/R of
// the largest d, and across the face a tilted circle is an ellipse, R tilt^2/2 higher. The sign of the
// moment: with a positive tilt the axis comes closer to the lever where zeta > 0. The bed is inclined, and what counts is the
// slope towards it.
TEST(ContactInSpace, ATiltedCylinderOnABedOfSpringsIsKnown)
{
  const std::tuple<double, double, double> known[] = { { 0., 45.8258, 0. },
                                                       { 4e-4, 46.4649, 190.402 },
                                                       { 8e-4, 48.4187, 377.345 },
                                                       { 1.2e-3, 51.8459, 555.492 },
                                                       { 2.4e-3, 71.4353, 1020.50 } };
  const double inclination                         = 0.08552; // at which the cylinder penetrates by d_0
  for (const auto &[tilt, P, M] : known)
  {
    const auto [force, moment] = Bed(tilted(tilt / std::cos(inclination)), 12.5).pressed_by(0.03);
    const double deepest       = 0.03 + 0.5 * width * tilt;
    const double approximation = 2. * deepest / 56. + 2.5 * 0.5 * 56. * tilt * tilt / deepest;
    EXPECT_NEAR(force, P, approximation * P) << tilt;
    EXPECT_NEAR(moment, M, approximation * std::max(M, 1.)) << tilt;
    const auto [mirrored_force, mirrored_moment] = Bed(tilted(-tilt / std::cos(inclination)), 12.5).pressed_by(0.03);
    EXPECT_NEAR(mirrored_force, force, 1e-9 * P);
    EXPECT_NEAR(mirrored_moment, -moment, 1e-8 * std::max(M, 1.));
  }
}

// P = pi K sqrt(R_1 R_2) d^2.
TEST(ContactInSpace, ABarrelOnABedOfSpringsIsKnown)
{
  Cylinder barrel;
  barrel.crown_radius = 500.;
  EXPECT_NEAR(Bed(barrel, 12.5, 60).pressed_by(0.03)[0], 5.91400, 2e-3 * 5.914);
}

TEST(ContactInSpace, AShortCylinderPressesOnItsLength)
{
  Cylinder cylinder;
  cylinder.length = 30.;
  EXPECT_NEAR(Bed(cylinder, 12.5).pressed_by(0.03)[0], 45.8258 * 30. / width, 1e-3 * 45.8258);
}

TEST(ContactInSpace, FrictionOpposesTheSlipWhicheverWayItGoes)
{
  Bed bed({}, 12.5);
  const auto end = bed.pressed(0.03);
  auto begin     = end;
  for (unsigned int dof = 0; dof < bed.layout.surface; dof += 3)
  {
    begin[dof] -= 0.3; // the points come along xi by 0.3 and along zeta by 0.4
    begin[dof + 2] -= 0.4;
  }
  const auto found = bed.evaluated(begin, Bed::x, end, 0.5);
  double closed    = 0.;
  for (const auto &point : found.points)
    if (point.pressure > 0.)
    {
      closed += 1.;
      EXPECT_TRUE(point.slipping);
      EXPECT_NEAR(point.traction.norm(), 0.5 * point.pressure, 1e-12);
      // The slip round the cylinder is measured on its surface, which lies up to 0.03 mm off the points: 5.4e-4 of it.
      EXPECT_NEAR(point.traction[1] / point.traction[0], 0.4 / 0.3, 1e-3);
      EXPECT_NEAR(point.end_force[2], -0.5 * point.pressure * 0.8, 3e-4 * point.pressure);
    }
  EXPECT_GT(closed, 1000.);
}

namespace
{
  /// A change of all displacements by movements of up to 1 mm.
  dealii::Vector<double> any_change(const Bed &bed)
  {
    auto result = random_vector(bed.layout.size(), 1., 1);
    for (unsigned int dof = 0; dof < result.size(); ++dof)
      result[dof] /= bed.unit_length(dof);
    return result;
  }

  /// Makes forces of the moments on the slopes.
  void weigh(const Bed &bed, const DofSelection &dofs, dealii::Vector<double> &forces)
  {
    for (unsigned int i = 0; i < dofs.size(); ++i)
      forces[i] /= bed.unit_length(dofs[i]);
  }
} // namespace

/// The parameter says if the axis is free on its shaft.
class ContactInSpaceOfAnAxis : public testing::TestWithParam<bool>
{
};

INSTANTIATE_TEST_SUITE_P(IsFree, ContactInSpaceOfAnAxis, testing::Bool());

// Friction changes with the speed. Displacements are those of a slide at rest; points at the edge of the contact change their
// state on the way.
TEST_P(ContactInSpaceOfAnAxis, SlidingIsLinearisedByDisplacementsAndVelocities)
{
  const FrictionLaw friction{ StribeckFriction{ 0.9, 0.6, 30., 1., 1e-3 } };
  Bed bed(skewed(GetParam()), 12.5, 6, friction);
  auto displacements = bed.pressed(0.03);
  for (unsigned int dof = 0; dof < bed.layout.surface; ++dof)
    displacements[dof] += 1e-3 * std::sin(1.3 * dof);
  auto rates = random_vector(bed.layout.size(), 20., 3);
  for (unsigned int dof = 0; dof < rates.size(); ++dof)
    rates[dof] /= bed.unit_length(dof);
  const DrivePoint drive{ 0., Bed::x, 112., 0. };
  const double speed = 100.;
  const auto change  = any_change(bed);
  for (const bool by_rates : { false, true })
  {
    const auto at_rest = dealii::Vector<double>(bed.layout.size());
    const auto &moving = by_rates ? rates : at_rest;
    FaceEvaluation<3> found;
    const auto linear = bed.surface().linearise({ displacements, drive, speed, &moving, ContactFriction::sliding }, found);
    const double step = by_rates ? 1e-3 : 1e-7;
    const auto forces = [&](const double side)
    {
      auto at = displacements, with = moving;
      (by_rates ? with : at).add(side * step, change);
      FaceEvaluation<3> result;
      bed.surface().evaluate_sliding({ at, drive, speed, &with, ContactFriction::sliding }, result);
      EXPECT_EQ(result.forces.dofs, linear.dofs);
      return result.forces.values;
    };
    dealii::Vector<double> dof_values(static_cast<unsigned int>(linear.dofs.size())), slope(dof_values.size());
    for (unsigned int i = 0; i < dof_values.size(); ++i)
      dof_values[i] = change[linear.dofs[i]];
    (by_rates ? linear.damping() : linear.stiffness()).vmult(slope, dof_values);
    EXPECT_GT(slope.l2_norm(), 0.);
    auto difference = forces(1.);
    difference -= forces(-1.);
    difference /= 2. * step;
    difference -= slope;
    weigh(bed, linear.dofs, difference);
    weigh(bed, linear.dofs, slope);
    EXPECT_LT(difference.l2_norm(), (by_rates ? 1e-7 : 1e-4) * slope.l2_norm()) << by_rates;
  }
}

// Its forces without the delayed ones are those of a constant mu, regularised or not.
TEST_P(ContactInSpaceOfAnAxis, AFallingFrictionFollowsTheSpeedOverItsMemory)
{
  const double speed    = -40.;
  const auto linearised = [&](FrictionLaw friction, const double regularisation)
  {
    friction.memory_length        = 0.02;
    friction.regularisation_speed = regularisation;
    Bed bed(skewed(GetParam()), 12.5, 6, friction);
    const auto displacements = bed.pressed(0.03);
    FaceEvaluation<3> found;
    return bed.surface().linearise({ displacements, { 0., Bed::x, speed, 0. }, speed }, found);
  };
  for (const double regularisation : { 0., 20. })
  {
    const auto linear   = linearised({ StribeckFriction{ 0.9, 0.6, 30. } }, regularisation);
    const auto constant = linearised({ CoulombFriction{ 0.6 + 0.3 * std::exp(-40. / 30.) } }, regularisation);
    EXPECT_TRUE(constant.delays.empty());
    EXPECT_FALSE(linear.delays.empty());
    for (const auto &delay : linear.delays)
      EXPECT_DOUBLE_EQ(delay.time, 0.02 / 40.);
    auto difference = linear.immediate_damping();
    difference.add(-1., constant.damping());
    EXPECT_LT(difference.linfty_norm(), 1e-10 * linear.damping().linfty_norm());
    auto falls = linear.damping();
    falls.add(-1., constant.damping());
    EXPECT_GT(falls.linfty_norm(), 0.1 * linear.damping().linfty_norm());
  }
}

TEST(ContactInSpace, PartsAddUpToTheTangentAndPressureIsSymmetric)
{
  Bed bed(Cylinder(), 12.5, 6, { CorkOnAluminium{}, FrictionSpeed::sliding });
  expect_tangent_parts(bed.surface(), bed.pressed(0.03), 1e-14, Bed::x);
}

// A slide leaves out the delay of friction across the slip, and this test the displacements along zeta.
TEST(ContactInSpace, FrictionThatGrowsWithSpeedIsDelayedAsInSteps)
{
  Bed bed(Cylinder(), 12.5, 2, { CorkOnAluminium{}, FrictionSpeed::sliding });
  auto at = bed.pressed(0.03);
  for (unsigned int dof = 0; dof < bed.layout.surface; ++dof)
    at[dof] += 1e-3 * std::sin(1.7 * dof);
  expect_delays_as_in_steps(bed.surface(), at, Bed::x, 1e-4,
                            [&](const unsigned int dof) {
                              return dof < bed.layout.surface && dof % 3 == 2 ? 0.
                                                                              : 2e-6 / (dof < bed.layout.surface ? 1. : 120.);
                            });
}

// On a long way the contact is at both ends, and passes over the rest.
TEST(ContactInSpace, ALongStepReachesWhereItBeginsAndEnds)
{
  const double theta = 0.085, middle = cylinder_centre(model_a().geometry, Bed::x, theta).xi;
  const auto reached = [&](const double travel)
  {
    Bed bed(Cylinder(), 12.5, 2);
    const auto &dofs = bed.surface().candidate_dofs(Bed::x - 0.5 * travel, { { theta } }, travel);
    return [nodes = bed.friction_face().nodes, dofs](const double xi)
    {
      return std::any_of(nodes.begin(), nodes.end(),
                         [&](const auto &node)
                         {
                           const auto dof = 3 * static_cast<unsigned int>(&node - nodes.data());
                           return std::abs(node.position[0] - xi) < 0.5 && std::binary_search(dofs.begin(), dofs.end(), dof);
                         });
    };
  };
  for (const double travel : { 2., 5., 9. })
  {
    const auto is_reached = reached(travel);
    EXPECT_TRUE(is_reached(middle - 0.5 * travel));
    EXPECT_TRUE(is_reached(middle + 0.5 * travel));
    EXPECT_EQ(is_reached(middle), travel < 9.);
  }
}
