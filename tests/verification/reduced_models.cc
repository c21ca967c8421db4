// SPDX-License-Identifier: GPL-3.0-only
#include "analysis/transient/transient.h"
#include "analytic/oscillation.h"
#include "results/row_statistics.h"
#include "scene/closed_form.h"
#include "scene/scene.h"
#include "verification/run_transient.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

using namespace sprag;

namespace
{
  /// Interpolates linearly between the rows beside the time.
  double value_at(const std::vector<Row> &rows, const double time, const Column column)
  {
    const auto after  = std::lower_bound(rows.begin() + 1, rows.end() - 1, time,
                                         [](const Row &row, const double value) { return row[Column::time] < value; });
    const Row &end    = *after;
    const Row &begin  = *(after - 1);
    const double part = (time - begin[Column::time]) / (end[Column::time] - begin[Column::time]);
    return begin[column] + part * (end[column] - begin[column]);
  }

  /// Largest distance of a column between two runs, at the times of the first.
  double largest_difference(const std::vector<Row> &rows, const std::vector<Row> &reference, const Column column)
  {
    double largest = 0.;
    for (const auto &row : rows)
      largest = std::max(largest, std::abs(row[column] - value_at(reference, row[Column::time], column)));
    return largest;
  }

  /// From steady sliding at x = 45 over the reversal at 65 and back.
  Scene around_the_reversal(const Scene &scene)
  {
    return with_drive(scene, Drive(DriveProfile::triangle, 45., 65., 112., 1., 5e-3));
  }

  Scene aluminium_lever(const Scene &scene)
  {
    return with_lever(in_time(scene, ModelType::beam), 20., 7767., 1.426);
  }
} // namespace

// Problem 15. The contact yields by delta = P/k, as if e were less by it: that takes the share k_theta/(s (s + sigma mu e))/k, at
// most 7.1e-6, off theta - theta_0 and off P. J theta'' is 1e-6 of the spring's moment. Fast steps beside the contact's period,
// 160 of its radians, magnify round-off of the gap to some 1e-5 N.
TEST(RigidLever, FollowsTheClosedFormOnAStiffContactAtLowSpeed)
{
  for (const auto &paper : { model_a(), model_b(), with_coulomb(model_a(), 0.73) })
  {
    Scene scene             = with_spectral_radius(with_fixed_step(in_time(paper, ModelType::rigid), 1e-3), 0.5);
    scene.drive             = Drive(DriveProfile::triangle, 0., 65., 5., 1., 0.4);
    scene.contact.stiffness = 1e6;
    const auto rows         = run_in_time(scene).rows;
    const double turn       = scene.drive.reversals().front();
    double worst            = 0.;
    for (const auto &row : rows)
    {
      if (row[Column::x] < 5. || std::abs(row[Column::time] - turn) < 1.)
        continue;
      const auto ideal   = closed_form(scene, row[Column::x], row[Column::v]);
      const double arm   = ideal.contact.s + std::copysign(ideal.mu, row[Column::v]) * scene.geometry.interface_offset;
      const double share = scene.spring.stiffness / (ideal.contact.s * arm) / scene.contact.stiffness;
      const double off   = share + 2e-6;
      EXPECT_NEAR(row[Column::P], ideal.P, off * ideal.P + 2e-5) << "x " << row[Column::x];
      EXPECT_NEAR(row[Column::Q], ideal.Q, off * (ideal.P * ideal.mu + std::abs(ideal.Q)) + 2e-5) << "x " << row[Column::x];
      EXPECT_NEAR(row[Column::theta], ideal.contact.theta - ideal.P / scene.contact.stiffness / ideal.contact.s,
                  1e-4 * ideal.P / scene.contact.stiffness / ideal.contact.s);
      worst = std::max(worst, std::abs(row[Column::P] - ideal.P) / ideal.P);
    }
    RecordProperty("largest_relative_deviation_of_P", std::to_string(worst));
  }
}

// Both levers have the same J. At the true modulus the bending flexibility s^3/(3 EI) is 0.6 of the contact's 1/k_c, with a
// larger E that much less, and P, theta and the frequency of the ringing differ by less than this share.
TEST(Beam, TendsToTheRigidLeverInProportionToItsFlexibility)
{
  const Scene base = with_fixed_step(around_the_reversal(with_coulomb(in_time(model_a(), ModelType::rigid), 0.73)), 5e-5);
  const auto rigid = run_in_time(base).rows;
  double before    = 0.;
  for (const double factor : { 1e4, 1e5, 1e6, 1e7, 1e8 })
  {
    Scene scene          = base;
    scene.analysis.model = ModelType::beam;
    scene.lever.young_modulus *= factor;
    const auto rows      = run_in_time(scene).rows;
    const double P_error = largest_difference(rows, rigid, Column::P) / largest(rigid, Column::P);
    const double theta   = largest_difference(rows, rigid, Column::theta) / largest(rigid, Column::theta);
    EXPECT_LT(P_error, 0.6 / factor);
    EXPECT_LT(theta, 0.6 / factor);
    // Round-off of a penetration of 0.01 mm between lengths of 200 mm rings along: 5e-11 of P in the smaller difference.
    if (before > 0.)
    {
      EXPECT_NEAR(before / P_error, 10., 0.05 + 5e-10 / P_error) << factor;
    }
    before = P_error;
    RecordProperty("P_at_" + std::to_string(factor), std::to_string(P_error * factor) + "/factor");
  }
}

// Against steps of 2 microseconds, which err by 1e-5 themselves, two hundredths of the smaller tolerance.
TEST(TimeTolerance, BoundsTheErrorOfPOfALeverThatRings)
{
  for (const auto &paper : { model_a(), model_b() })
  {
    Scene scene          = with_drive(aluminium_lever(paper), Drive(DriveProfile::triangle, 60., 65., 112., 1., 5e-3));
    const auto reference = run_in_time(with_spectral_radius(with_fixed_step(scene, 2e-6), 1.)).rows;
    for (const double tolerance : { scene.time.tolerance, 1e-3 })
    {
      scene.time.tolerance = tolerance;
      const double error   = largest_difference(run_in_time(scene).rows, reference, Column::P) / largest(reference, Column::P);
      EXPECT_LT(error, tolerance);
      RecordProperty("error_over_tolerance", std::to_string(error / tolerance));
    }
  }
}

// J a thousandth: going forward the contact vibrates by itself at 11 kHz, growing by 700/s. Steps that nothing tells of it damp
// it away. The stick of its cycle leaves peaks of single runs 2 % apart.
TEST(StiffModes, AreFollowedWhereTheyGrow)
{
  Scene scene                   = with_lever(in_time(model_a(), ModelType::rigid), 20., 9541.32, 1.45485);
  scene.lever.moment_of_inertia = 6.45e-3;
  scene.drive                   = Drive(DriveProfile::triangle, 50., 65., 112., 0.5, 5e-3);
  const auto reference          = contact_reference(scene);
  const auto compute_peak       = [&](const TimeSettings &time, const double longest)
  {
    const auto model = make_reduced_lever(scene);
    double most      = 0.;
    run_transient(*model, scene.drive, { time, reference.P, reference.stiffness, 0.25, longest },
                  [&](const Motion &, const Row &row) { most = std::max(most, row[Column::P]); });
    return most;
  };
  const auto model     = make_reduced_lever(scene);
  const double longest = longest_step(growing_modes(*model, scene.drive), scene.time.spectral_radius);
  const double fine    = compute_peak({ 2e-6, 0., 1. }, longest);
  const double found   = compute_peak(scene.time, longest);
  EXPECT_GT(fine, 25.);
  EXPECT_NEAR(found, fine, 0.02 * fine);
  EXPECT_LT(compute_peak(scene.time, std::numeric_limits<double>::infinity()), 0.6 * fine);
  std::cout << "peak of P: " << fine << " N in steps of 2e-6 s, " << found << " in adaptive ones of up to " << longest << " s\n";
}
