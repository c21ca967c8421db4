// SPDX-License-Identifier: GPL-3.0-only
#include "model/contact/contact_step.h"

#include "model/contact/circle.h"

#include <cmath>
#include <gtest/gtest.h>

using namespace sprag;

namespace
{
  constexpr unsigned int n = 4;
  using Coordinates        = dealii::Tensor<1, n>;

  const Geometry geometry = { 56., 45.6, 185.5, 4. };
  constexpr double x      = 23.;
  constexpr double theta  = 0.071;

  /// A point of the lever at a chosen gap [mm], a little aside of the line through the centre along eta.
  LeverPoint point_at(const double gap)
  {
    const auto centre = cylinder_centre(geometry, x, theta);
    const double beta = 0.03;
    return { centre.xi + (56. + gap) * std::sin(beta), centre.eta + (56. + gap) * std::cos(beta) };
  }

  struct Case
  {
    double gap;
    ContactHistory history;
    StepContactLaw law;
    double slip_begin = 0.;

    ContactKinematics<n> kinematics(const Coordinates &q = {}) const
    {
      const auto point = point_at(gap);
      return moving_circle_contact(placed_for_points(geometry, x + q[3], theta + q[2]), { point.xi + q[0], point.eta + q[1] });
    }

    StepResponse<n> response(const Coordinates &q = {}, const FrictionMode mode = FrictionMode::cone) const
    {
      StepContactLaw in_mode = law;
      in_mode.mode           = mode;
      return step_response(step_to(kinematics(q), slip_begin), history, in_mode);
    }
  };

  const FrictionLaw coulomb = { CoulombFriction{ 0.73 }, FrictionSpeed::sliding };
  const FrictionLaw cork    = { CorkOnAluminium{}, FrictionSpeed::sliding };

  /// Pressure 2 MPa from the gap (`multiplier` + 500 N/mm^3 gap) and a slip of `slip` mm in a step of 1 mm at 112 mm/s.
  Case make_case(const double multiplier, const double slip, const double traction, const FrictionLaw &friction)
  {
    Case result{ (multiplier - 2.) / 500., {}, {} };
    result.history.normal_multiplier = multiplier;
    result.history.traction[0]       = traction;
    result.law.normal                = { 500., 1. };
    result.law.slip.stiffness        = 300.;
    result.law.slip.friction         = friction;
    result.law.weights.dt            = 1. / 112.;
    result.law.balance               = ForceBalance::end;
    result.slip_begin                = result.kinematics().slip - slip;
    return result;
  }

  // Central differences over h (a rotation h / 100) err by h^2 / 6 of the force's third derivative, at most
  // mu'' (112 /s)^2 500 N/mm^3 = 115 N/mm^5 (2.25 as much over a rotation), and by 500 N/mm^3 of the round-off of gaps of 100 mm
  // positions over h; both times the arms of the rotation.
  void expect_tangent(const Case &contact, const FrictionMode mode = FrictionMode::cone)
  {
    const auto exact = contact.response({}, mode);
    for (unsigned int j = 0; j < n; ++j)
      for (const double h : { 1e-4, 1e-5, 1e-6 })
      {
        Coordinates q;
        q[j]               = j == 2 ? h / 100. : h;
        const auto right   = contact.response(q, mode);
        const auto left    = contact.response(-1. * q, mode);
        const auto divided = (right.force - left.force) / (2. * q[j]);
        for (unsigned int i = 0; i < n; ++i)
        {
          const double arms = (i == 2 ? 150. : 1.) * (j == 2 ? 150. : 1.);
          EXPECT_NEAR(exact.tangent[i][j], divided[i], arms * (100. * h * h + 500. * 5e-14 / h)) << i << j << ", h " << h;
        }
      }
  }
} // namespace

TEST(ContactPoint, ForceIsPressureAlongTheGapLessTractionAlongTheSlip)
{
  const auto contact    = make_case(0., 0.9, 0., coulomb);
  const auto kinematics = contact.kinematics();
  const auto response   = contact.response();
  EXPECT_NEAR(response.pressure, 2., 1e-10);
  EXPECT_NEAR(response.traction[0], 1.46, 1e-10);
  EXPECT_NEAR((response.force - response.pressure * kinematics.gap_row + response.traction[0] * kinematics.slip_row).norm(), 0.,
              1e-12);
}

TEST(ContactPoint, MomentIsThatOfTheForceAboutThePivot)
{
  for (const double slip : { 0.001, 0.9, -0.9 })
  {
    const auto contact = make_case(0.5, slip, 0.1, cork);
    const auto point   = point_at(contact.gap);
    const auto force   = contact.response().force;
    // theta turns xi into eta; round-off of terms of 300 N/mm.
    EXPECT_NEAR(force[2], point.xi * force[1] - point.eta * force[0], 1e-12);
  }
}

TEST(ContactPoint, OpenPointsCarryNothing)
{
  for (const double multiplier : { 0., 0.5 })
  {
    auto contact = make_case(multiplier, 0.9, 0.3, cork);
    contact.gap += 0.0041; // 2 MPa / 500 N/mm^3 and a bit
    const auto response = contact.response();
    EXPECT_EQ(response.pressure, 0.);
    EXPECT_EQ(response.traction, Slip());
    EXPECT_FALSE(response.slipping);
    EXPECT_EQ(response.force.norm(), 0.);
    EXPECT_EQ(response.tangent.norm(), 0.);
  }
}

TEST(ContactPoint, SlipFromATractionStopsAtTheConeOfThePresentPressure)
{
  const auto contact  = make_case(0., 0.5, -1., coulomb);
  const auto response = contact.response();
  EXPECT_TRUE(response.slipping);
  EXPECT_NEAR(response.traction[0], 0.73 * response.pressure, 1e-12);
}

TEST(ContactPoint, StickModeIgnoresTheCone)
{
  const auto contact = make_case(0., 0.9, 0.2, coulomb);
  EXPECT_NEAR(contact.response({}, FrictionMode::stick).traction[0], 0.2 + 300. * 0.9, 1e-10);
}

TEST(ContactPoint, TangentInStickIsTheDerivativeOfTheForce)
{
  for (const double multiplier : { 0., 0.5, 2.5 })
    expect_tangent(make_case(multiplier, 0.001, 0.2, cork));
}

TEST(ContactPoint, TangentInSlipIsTheDerivativeOfTheForce)
{
  for (const double multiplier : { 0., 0.5, 2.5 })
    for (const double slip : { 0.9, -0.9 })
      for (const auto &law : { coulomb, cork })
        expect_tangent(make_case(multiplier, slip, 0.2, law));
}

TEST(ContactPoint, TangentInStickModeIsTheDerivativeOfTheForce)
{
  expect_tangent(make_case(0.5, 0.9, 0.2, cork), FrictionMode::stick);
}

namespace
{
  // A point on a surface, three coordinates: a gap that curves and slips that bend with the others.
  using Place = dealii::Tensor<1, 3>;

  StepKinematics<3, 2> surface_step(const Place &q_0, const Place &q_1)
  {
    const auto gap = [](const Place &q) { return q[2] + 0.02 * (q[0] * q[0] + 0.5 * q[1] * q[1]); };
    StepKinematics<3, 2> step;
    step.gap_begin     = gap(q_0);
    step.gap_end       = gap(q_1);
    step.gap_row_end   = Place({ 0.04 * q_1[0], 0.02 * q_1[1], 1. });
    const Place middle = 0.5 * (q_0 + q_1);
    step.gap_row       = Place({ 0.04 * middle[0], 0.02 * middle[1], 1. });
    // The row is that of the middle, which moves by half of the end's motion.
    step.gap_curvature[0][0] = 0.02;
    step.gap_curvature[1][1] = 0.01;
    for (unsigned int s = 0; s < 2; ++s)
    {
      const auto slip            = [s](const Place &q) { return q[s] + 0.03 * q[1 - s] * q[2]; };
      step.slip_change[s]        = slip(q_1) - slip(q_0);
      step.slip_change_row[s][s] = step.slip_row[s][s] = 1.;
      step.slip_change_row[s][1 - s]                   = 0.03 * q_1[2];
      step.slip_change_row[s][2]                       = 0.03 * q_1[1 - s];
      step.slip_row[s][1 - s]                          = 0.03 * middle[2];
      step.slip_row[s][2]                              = 0.03 * middle[1 - s];
      step.slip_curvature[s][1 - s][2] = step.slip_curvature[s][2][1 - s] = 0.015;
    }
    return step;
  }
} // namespace

TEST(ContactPoint, OnASurfaceTheTangentIsTheDerivativeOfTheForce)
{
  for (const auto balance : { ForceBalance::mean, ForceBalance::end })
    for (const auto &friction : { coulomb, cork })
      for (const double slip : { 1e-4, 0.04, 0.4 })
      {
        StepContactLaw law;
        law.normal         = { 500., 1. };
        law.slip.stiffness = 300.;
        law.slip.friction  = friction;
        law.weights        = generalised_alpha(0.8, 2e-3);
        law.weights.dt     = 2e-3;
        law.balance        = balance;
        const ContactHistory history{ 0.1, dealii::Tensor<1, 2>({ 0.5, 0.2 }), 0., dealii::Tensor<1, 2>({ 90., 40. }), 1e-3 };
        const Place from({ 0.1, -0.2, -0.02 });
        const Place to   = from + Place({ slip, -0.7 * slip, -0.0007 });
        const auto at    = [&](const Place &q) { return step_response(surface_step(from, q), history, law); };
        const auto exact = at(to);
        EXPECT_EQ(exact.slipping, slip > 1e-3);
        EXPECT_LE(exact.traction.norm(), exact.mu * exact.pressure * (1. + 1e-12));
        for (unsigned int j = 0; j < 3; ++j)
        {
          Place change;
          change[j]          = 1e-7;
          const auto divided = (at(to + change).force - at(to - change).force) / 2e-7;
          for (unsigned int i = 0; i < 3; ++i)
            EXPECT_NEAR(exact.tangent[i][j], divided[i], 1e-5 * exact.tangent.norm()) << i << j << ", slip " << slip;
        }
      }
}
