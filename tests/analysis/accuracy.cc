// SPDX-License-Identifier: GPL-3.0-only
#include "analysis/accuracy/slide_samples.h"
#include "analysis/accuracy/step_errors.h"
#include "analytic/error_estimate.h"
#include "scene/closed_form.h"
#include "scene/scene.h"
#include "scenes.h"

#include <cmath>
#include <gtest/gtest.h>

using namespace sprag;

namespace
{
  /// A row in which the whole contact slides, or only a share of it.
  Row row(const double time, const double x, const double v, const double P, const double share = 1.)
  {
    Row result;
    result[Column::time]               = time;
    result[Column::x]                  = x;
    result[Column::v]                  = v;
    result[Column::P]                  = P;
    result[Column::normal_resultant]   = P;
    result[Column::mu]                 = 0.5;
    result[Column::friction_resultant] = (v < 0. ? -0.5 : 0.5) * share * P;
    result[Column::largest_pressure]   = P;
    result[Column::contact_width]      = 2.;
    return result;
  }

  /// There and back over 20 mm in steps of 1 mm; behind the turning point the contact sticks for 3 mm.
  std::vector<Row> there_and_back()
  {
    std::vector<Row> rows;
    for (unsigned int i = 0; i <= 20; ++i)
      rows.push_back(row(i, i, 1., 0.1 * i));
    for (unsigned int i = 1; i <= 20; ++i)
      rows.push_back(row(20. + i, 20. - i, -1., 0.2 * (20. - i), i <= 3 ? 0.5 : 1.));
    return rows;
  }
} // namespace

TEST(ErrorEstimate, OfTheFinerResultIsAShareOfTheDifference)
{
  // Values 3 + 5 h^2 at h = 0.2 and 0.1: the finer is 0.05 off.
  EXPECT_NEAR(finer_share(2., 2.) * ((3. + 5. * 0.04) - (3. + 5. * 0.01)), 0.05, 1e-14);
  EXPECT_DOUBLE_EQ(finer_share(3., 1.), 0.5);
}

TEST(ErrorEstimate, AddsItsPartsAndNamesTheLargest)
{
  const ErrorEstimate estimate{ "P", "its peak", { { "mesh", 1e-3, "" }, { "penalty", 3e-3, "" } }, "" };
  EXPECT_DOUBLE_EQ(total_error(estimate), 4e-3);
  EXPECT_EQ(largest_part(estimate).name, "penalty");
  EXPECT_TRUE(std::isnan(total_error({ "P", "", {}, "No estimate." })));
}

TEST(SlideSamples, LieWhereAllSlidesAndTheTurnIsForgotten)
{
  const auto samples = slide_samples(there_and_back(), 4);
  ASSERT_GE(samples.size(), 8u);
  double time           = -1.;
  unsigned int backward = 0;
  for (const Row &sample : samples)
  {
    EXPECT_GT(sample[Column::time], time);
    time = sample[Column::time];
    if (sample[Column::v] < 0.)
    {
      ++backward;
      EXPECT_LE(sample[Column::x], 16.);
    }
    EXPECT_GT(sample[Column::P], 0.);
  }
  EXPECT_EQ(backward, 5u); // four and the one of the largest P
  EXPECT_EQ(samples[4][Column::x], 20.);
  EXPECT_TRUE(slide_samples({ row(0., 0., 1., 0.) }, 4).empty());
}

TEST(SampleChanges, AreRelativeToPeaksOrThemselves)
{
  std::vector<Row> rows = { row(0., 0., 1., 1.), row(1., 1., 1., 4.) };
  for (Row &each : rows)
    each[Column::Q] = 10. * each[Column::P];
  auto other                         = rows;
  other[0][Column::P]                = 1.2;
  other[1][Column::largest_pressure] = 5.;
  EXPECT_NEAR(relative_change("P", rows, other), 0.05, 1e-14);
  other[0][Column::largest_pressure] = 9.; // below half of the largest
  EXPECT_NEAR(relative_change("largest_pressure", rows, other), 0.25, 1e-14);
  other[0][Column::largest_pressure] = rows[0][Column::largest_pressure] = 2.;
  rows[0][Column::contact_width]     = 1.; // half of that at the peak, errors of an eighth there
  other[0][Column::largest_pressure] = 6.;
  EXPECT_NEAR(relative_change("largest_pressure", rows, other), 0.25, 1e-14);
  EXPECT_DOUBLE_EQ(relative_change("Q", rows, other), 0.);
  EXPECT_THROW(relative_change("theta", rows, other), std::out_of_range);
}

TEST(RowSpacing, GoesWithTheRootOfTheErrorAndHoldsIt)
{
  const Scene scene  = with_coulomb(model_a(), 0.73);
  const double small = largest_row_spacing(scene, 1e-4, true);
  EXPECT_NEAR(largest_row_spacing(scene, 4e-4, true) / small, 2., 0.3);
  EXPECT_LE(largest_row_spacing(scene, 0.4, true), 0.25 * 65.);
  // P of the closed form between two rows around x = 60 mm against the straight line, over the largest P, which is backward.
  const auto P      = [&](const double x) { return closed_form(scene, x, -112.).P; };
  const double line = 0.5 * (P(60. - 0.5 * small) + P(60. + 0.5 * small));
  EXPECT_LE(std::abs(P(60.) - line) / P(65.), 1e-4);
}

// Mu of cork changes with the root of the distance from the turning point, before which the drive slows down. Lines between rows
// that its speed keeps close are within 0.1 % there all the same, the first half a millimetre apart.
TEST(RowSpacing, IsThatOfTheLargestSpeed)
{
  Scene scene           = model_a();
  const double constant = largest_row_spacing(scene, 3e-4, true);
  scene.drive           = Drive(DriveProfile::harmonic, 0., 65., 112., 1., 0.);
  EXPECT_DOUBLE_EQ(largest_row_spacing(scene, 3e-4, true), constant);
  std::vector<Row> rows;
  scene.analysis.step = constant;
  run_closed_form(scene, [&](const Row &row) { rows.push_back(row); });
  double largest_error = 0.;
  for (std::size_t i = 1; i < rows.size(); ++i)
  {
    const auto &[from, to] = std::tie(rows[i - 1], rows[i]);
    const auto middle      = scene.drive.at(0.5 * (from[Column::time] + to[Column::time]));
    if (from[Column::v] * to[Column::v] < 0. || 65. - middle.x < 0.5)
      continue;
    const double share = (middle.x - from[Column::x]) / (to[Column::x] - from[Column::x]);
    const double line  = (1. - share) * from[Column::Q] + share * to[Column::Q];
    largest_error      = std::max(largest_error, std::abs(closed_form(scene, middle.x, middle.v).Q - line));
  }
  EXPECT_LE(largest_error / 9.9, 1e-3);
}

TEST(ChangeByFrequency, IsTheLagOfADecayingVibration)
{
  // P = 10 + exp(-20 t) sin(w t) behind a reversal at t = 1 s: slower by a share d it changes by d w t exp(-20 t) at most.
  // Its lag is told from the overshoot on, a quarter of a period later.
  const double omega = 2. * M_PI * 200., decay = 20.;
  const auto vibration = [&](const double t, const double slow)
  { return std::exp(-decay * t) * std::sin(omega * (1. - slow) * t); };
  std::vector<Row> rows;
  double largest_lag     = 0.;
  constexpr double share = 1e-4;
  for (double t = 0.; t < 0.5; t += 2e-5)
  {
    rows.push_back(row(1. + t, 0., -1., 10. + vibration(t, 0.)));
    rows.back()[Column::P_quasi_static] = 10.;
    largest_lag                         = std::max(largest_lag, std::abs(vibration(t, share) - vibration(t, 0.)));
  }
  EXPECT_NEAR(share * change_by_frequency(rows, 1., 2.), largest_lag, 0.03 * largest_lag);
}

TEST(EstimateStepErrors, TakesTheLongestStepUpToTheOvershoot)
{
  // Friction turns at 1 s in steps of 1e-5 s. |P| is largest at 1.0105 s, many periods of 500 Hz later, as a slow reversal swells
  // the ringing: behind steps of 4e-5 s, in one of 2e-5 s, before those of 8e-5 s.
  const double omega = 2. * M_PI * 500.;
  const auto step_at = [](const double t) { return t < 0.008 ? 1e-5 : t < 0.009 ? 4e-5 : t < 0.015 ? 2e-5 : 8e-5; };
  const auto itself  = [](const double dt) { return dt; };
  for (const double sign : { 1., -1. })
  {
    std::vector<Row> rows;
    for (double t = 0., dt = 1e-5; t < 0.03; dt = step_at(t), t += dt)
    {
      const double ringing = std::exp(-std::pow((t - 0.0105) / 0.004, 2)) * std::sin(omega * t);
      rows.push_back(row(1. + t, 0., -1., sign * (10. + ringing)));
      rows.back()[Column::P_quasi_static] = sign * 10.;
      rows.back()[Column::time_step]      = dt;
    }
    EXPECT_DOUBLE_EQ(estimate_step_errors(rows, 1., 2., itself).peak_step, 4e-5) << sign;
  }
}
