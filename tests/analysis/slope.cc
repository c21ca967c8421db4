// SPDX-License-Identifier: GPL-3.0-only
#include "analytic/closed_form.h"

#include "scene/closed_form.h"
#include "scene/scene.h"
#include "scenes.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

using namespace sprag;

namespace
{
  const double pi = std::acos(-1.);

  enum CoefficientColumn
  {
    mu,
    slope_forward,
    slope_backward,
    forward,
    backward
  };

  enum InclinationColumn
  {
    theta0,
    offset_ratio,
    forward_over_theta0,
    backward_over_theta0
  };

  /// Fig. 11: the mean mu of the experiments.
  Sweep over_inclination(const double maximum_inclination = pi / 3.)
  {
    Scene scene                     = with_coulomb(model_a(), 0.73);
    scene.slope.sweep               = SlopeSweep::inclination;
    scene.slope.maximum_inclination = maximum_inclination;
    return slope_sweep(scene);
  }

  std::vector<std::vector<double>> curve(const Sweep &sweep, const double ratio)
  {
    std::vector<std::vector<double>> rows;
    for (const auto &row : sweep.rows)
      if (row[offset_ratio] == ratio)
        rows.push_back(row);
    return rows;
  }
} // namespace

TEST(SlopeOverCoefficient, PassesThroughTheReferenceSlopes)
{
  // 121 points from 0 to 1.2: the 74th lies at mu = 0.73. Half a unit of the last printed digit.
  const auto a = slope_sweep(model_a()).rows.at(73), b = slope_sweep(model_b()).rows.at(73);
  EXPECT_NEAR(a[mu], 0.73, 1e-15);
  EXPECT_NEAR(a[slope_forward], 0.0804711777, 5e-11);
  EXPECT_NEAR(a[slope_backward], -0.0992025652, 5e-11);
  EXPECT_NEAR(a[forward], 0.0112964134, 5e-11);
  EXPECT_NEAR(a[backward], -0.0139258952, 5e-11);
  EXPECT_NEAR(b[slope_forward], 0.1566745505, 5e-11);
  EXPECT_NEAR(b[slope_backward], -0.1158129739, 5e-11);
  EXPECT_NEAR(b[forward], 0.0100000159, 5e-11);
  EXPECT_NEAR(b[backward], -0.0073919573, 5e-11);
}

TEST(SlopeOverInclination, BreaksOffWhereTheCylinderReachesThePivot)
{
  const auto sweep = over_inclination();
  // l = R, sin th0 = 1 - e/R: 53.13, 36.87, 23.58 and 11.54 degrees.
  for (const double ratio : { 0.2, 0.4, 0.6, 0.8 })
    EXPECT_NEAR((1. - ratio) / std::sin(curve(sweep, ratio).back()[theta0]), 1., 1e-15);
  EXPECT_NEAR(curve(sweep, 0.2).back()[theta0] * 180. / pi, 53.130, 5e-4);
  EXPECT_NEAR(curve(sweep, 0.8).back()[theta0] * 180. / pi, 11.537, 5e-4);
  EXPECT_EQ(curve(sweep, 0.).back()[theta0], pi / 3.);
}

TEST(SlopeOverInclination, RisesForwardAndTurnsBackwardNear25Degrees)
{
  const auto sweep = over_inclination();
  // Lowest points, from a second implementation: 25.2, 25.6 and 26.4 degrees. Points are 0.5 degrees apart or less.
  const std::vector<std::pair<double, double>> lowest = { { 0., 25.22 }, { 0.2, 25.60 }, { 0.4, 26.39 } };
  for (const auto &[ratio, angle] : lowest)
  {
    const auto rows = curve(sweep, ratio);
    const auto turn = std::min_element(
        rows.begin(), rows.end(), [](const auto &a, const auto &b) { return a[backward_over_theta0] < b[backward_over_theta0]; });
    EXPECT_NEAR((*turn)[theta0] * 180. / pi, angle, 0.3);
    for (std::size_t i = 1; i < rows.size(); ++i)
      EXPECT_GT(rows[i][forward_over_theta0], rows[i - 1][forward_over_theta0]);
  }
}

TEST(SlopeOverInclination, MeetsBothModelsAtTheirInclination)
{
  // Table 1 places the models on these curves: the same geometry divided by R.
  for (const Scene &model : { model_a(), model_b() })
  {
    Scene scene                     = with_coulomb(model, 0.73);
    const Geometry &g               = model.geometry;
    const double ratio              = g.interface_offset / g.cylinder_radius;
    scene.slope.sweep               = SlopeSweep::inclination;
    scene.slope.offset_ratios       = { ratio };
    scene.slope.maximum_inclination = kinematics(g, 0.).theta;
    const auto last                 = slope_sweep(scene).rows.back();
    EXPECT_NEAR(last[forward_over_theta0], dimensionless_slope(g, 0.73, 1), 1e-14);
    EXPECT_NEAR(last[backward_over_theta0], dimensionless_slope(g, 0.73, -1), 1e-14);
  }
}
