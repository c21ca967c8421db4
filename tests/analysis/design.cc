// SPDX-License-Identifier: GPL-3.0-only
#include "analysis/design/design_search.h"
#include "analysis/design/design_speed.h"
#include "base/errors.h"
#include "input/read.h"
#include "scene/closed_form.h"
#include "scene/scene.h"
#include "support/temporary_folder.h"

#include <gtest/gtest.h>

using namespace sprag;

// Levers whose best is known by hand. With e = 0, h = 0 and constant mu: s = l cos th0 at x = 0, th_x = tan th0/l, and
// C_Q = (+-mu cos th0 + sin th0) k sin th0/s^2, so that c = mu k tan th0/l^2 and k_e/c = tan th0/mu.

namespace
{
  constexpr double mu = 0.5;

  Scene read(const std::vector<std::string> &changes)
  {
    const TemporaryFolder folder;
    return read_scene(folder.write("scene.prm", ""), changes);
  }

  Scene design(const std::vector<std::string> &changes)
  {
    std::vector<std::string> all = { "Analysis/Type=design",           "Friction/Law=Coulomb",
                                     "Friction/Coefficient=0.5",       "Geometry/Interface offset=0",
                                     "Geometry/Cylinder radius=30",    "Geometry/Pivot distance=200",
                                     "Rotational spring/Stiffness=5e4" };
    all.insert(all.end(), changes.begin(), changes.end());
    return read(all);
  }

  Found best_design(const Scene &scene)
  {
    return best_lever(DesignProblem(scene));
  }

  /// Largest inclination with this ratio of the slopes: (mu + tan)/(mu - tan) = r.
  double inclination_for_ratio(const double ratio)
  {
    return std::atan(mu * (ratio - 1.) / (ratio + 1.));
  }

  double damping_slope(const double k, const double l, const double theta)
  {
    return mu * k * std::tan(theta) / (l * l);
  }
} // namespace

// Model A at 112 mm/s, where its cork has mu = 0.73, and at a tenth of that.
TEST(Design, AtATenthOfTheSpeedTheLeverDoesWhatItDoesOnSuchADrive)
{
  const auto scene_at = [&](const std::string &speed)
  {
    return read({ "Analysis/Type=design", "Drive/Speed=" + speed, "Design/Demands=largest force <= 1e3; damping slope >= 0.08" });
  };
  const Scene scene = scene_at("112"), slow = scene_at("11.2");
  const auto quantities = lever_quantities(scene), slowly = lever_quantities(slow);
  const auto found =
      design_speed(scene, { quantities[DesignQuantity::largest_force], quantities[DesignQuantity::damping_slope] });
  EXPECT_NEAR(found.other, 11.2, 1e-9);
  EXPECT_TRUE(std::isnan(found.amplitude));
  EXPECT_GT(found.mu, 1.2 * found.other_mu);
  EXPECT_NEAR(found.other_mu, closed_form(slow, 0., 11.2).mu, 1e-12);
  ASSERT_EQ(found.missed.size(), 1u);
  EXPECT_EQ(found.missed[0].demand, 1u);
  EXPECT_NEAR(found.missed[0].value, slowly[DesignQuantity::damping_slope], 1e-6);
}

TEST(Design, OfATableTheOtherSpeedIsThatOfItsOwnMotion)
{
  const Scene scene = read({ "Analysis/Type=design", "Isolation/Mass=0.5", "Isolation/Stiffness=9.67", "Isolation/Levers=8",
                             "Isolation/Base amplitude=10", "Isolation/Base frequency=0.7",
                             "Design/Demands=relative amplitude <= 100; friction ratio >= 0.01" });
  auto quantities   = lever_quantities(scene);
  add_table_quantities(scene, scene.design, quantities);
  const double amplitude = quantities[DesignQuantity::relative_amplitude];
  const auto found       = design_speed(scene, { amplitude, quantities[DesignQuantity::friction_ratio] });
  EXPECT_EQ(found.amplitude, amplitude);
  EXPECT_NEAR(found.other, 2. * M_PI * 0.7 * amplitude, 1e-9 * found.other);
  EXPECT_TRUE(found.missed.empty());
}

TEST(Design, SteepestLeverWithinARatioOfSlopes)
{
  const auto found = best_design(design({ "Design/Free=Geometry/Cylinder radius = 5 ... 100", "Design/Demands=slope ratio <= 1.8",
                                          "Design/Aim=maximise damping slope" }));
  ASSERT_TRUE(found.meets_all);
  const double theta = inclination_for_ratio(1.8);
  EXPECT_NEAR(found.lever.parameters[0], 200. * std::sin(theta), 1e-3 * 200. * std::sin(theta));
  EXPECT_NEAR(found.lever.quantities[DesignQuantity::damping_slope], damping_slope(5e4, 200., theta),
              1e-3 * damping_slope(5e4, 200., theta));
}

TEST(Design, LargestOffsetWithinAMarginToJamming)
{
  const auto found =
      best_design(design({ "Design/Free=Geometry/Interface offset = 0 ... 59", "Geometry/Cylinder radius=60",
                           "Design/Demands=jamming margin >= 0.8", "Design/Aim=maximise Geometry/Interface offset" }));
  ASSERT_TRUE(found.meets_all);
  // mu e/s = 0.2 at x = 65 with s^2 = (l - x)^2 - (R - e)^2: a quadratic equation for e.
  const double a = std::pow(mu / 0.2, 2) + 1., b = -2. * 60., c = 60. * 60. - 135. * 135.;
  const double e = (-b + std::sqrt(b * b - 4. * a * c)) / (2. * a);
  EXPECT_NEAR(found.lever.parameters[0], e, 1e-3 * e);
}

TEST(Design, ShortestLeverOfThreeFreeParameters)
{
  const auto found = best_design(design(
      { "Design/Free=Geometry/Cylinder radius = 15 ... 60; Geometry/Pivot distance = 90 ... 400; Rotational "
        "spring/Stiffness = 1e3 ... 2e5",
        "Design/Demands=damping slope = 0.1 +- 1e-5; slope ratio <= 1.8", "Design/Aim=minimise Geometry/Pivot distance" }));
  ASSERT_TRUE(found.meets_all);
  // Short is steep, and steep at the smallest radius that the bounds and the way of the drive leave: l - 65 > R, but a lever of
  // R = 15 is at the bound of the ratio only at l = 15/sin th0 = 107 mm, where c follows from k.
  const double theta = inclination_for_ratio(1.8), l = 15. / std::sin(theta);
  EXPECT_NEAR(found.lever.parameters[0], 15., 1e-3 * 15.);
  EXPECT_NEAR(found.lever.parameters[1], l, 1e-3 * l);
  const double k = 0.1 / damping_slope(1., l, theta);
  EXPECT_NEAR(found.lever.parameters[2], k, 1e-3 * k);
}

TEST(Design, WhatCannotBeMetNamesTheDemandThatStopsIt)
{
  const Scene scene = design({ "Design/Free=Geometry/Cylinder radius = 5 ... 100",
                               "Design/Demands=inclination <= 60; slope ratio <= 1.2; damping slope >= 0.1",
                               "Design/Aim=minimise largest force" });
  const DesignProblem problem(scene);
  const auto found = best_lever(problem);
  EXPECT_FALSE(found.meets_all);
  EXPECT_GT(found.distance, 0.);
  const auto stopping = stopping_demands(problem);
  ASSERT_EQ(stopping.size(), 2u);
  // Each of the two is met without the other; at the other's bound it can have so much.
  EXPECT_EQ(stopping[0].demand, 1u);
  EXPECT_EQ(stopping[1].demand, 2u);
  const double largest = damping_slope(5e4, 200., inclination_for_ratio(1.2));
  EXPECT_NEAR(stopping[1].attainable, largest, 1e-3 * largest);
}

// c is proportional to mu and k: with mu 20 % off either way it is 20 % off at best, where k gives the target itself.
TEST(Design, TheNearestIsTheOneWithTheBestWorstCorner)
{
  const DesignProblem problem(
      design({ "Design/Free=Rotational spring/Stiffness = 1e4 ... 2e5", "Design/Aim=minimise largest force",
               "Design/Demands=damping slope = 0.1 +- 0.001", "Design/Tolerances=Friction/Factor = 0.8 ... 1.2" }));
  const auto stopping = stopping_demands(problem);
  ASSERT_EQ(stopping.size(), 1u);
  EXPECT_NEAR(std::abs(stopping[0].attainable - 0.1), 0.02, 1e-4);
}

TEST(Design, DemandsHoldWithinTolerances)
{
  // c is proportional to mu and k.
  const auto find = [&](const std::vector<std::string> &more)
  {
    std::vector<std::string> changes = { "Design/Free=Rotational spring/Stiffness = 1e3 ... 1e6",
                                         "Design/Demands=damping slope >= 0.1", "Design/Aim=minimise largest force" };
    changes.insert(changes.end(), more.begin(), more.end());
    return best_design(design(changes));
  };
  const auto exact = find({}), tolerant = find({ "Design/Tolerances=Friction/Factor = 0.8 ... 1.1" });
  ASSERT_TRUE(exact.meets_all && tolerant.meets_all);
  EXPECT_NEAR(tolerant.lever.parameters[0], exact.lever.parameters[0] / 0.8, 1e-4 * exact.lever.parameters[0]);
  EXPECT_NEAR(tolerant.lever.quantities[DesignQuantity::damping_slope], 0.1 / 0.8, 1e-5);
  EXPECT_NEAR(tolerant.lever.worst[0], 0.1, 1e-5);
  // The lever locks at mu = l/e, which a tolerance may reach.
  EXPECT_FALSE(find({ "Geometry/Interface offset=20", "Design/Tolerances=Friction/Factor = 1 ... 30" }).meets_all);
  // With a preload friction that depends on the speed counts in the slopes as well. Model A by the rule of five points.
  const Scene preloaded = read({ "Analysis/Type=design", "Rotational spring/Rest angle=-0.05" });
  const auto slope      = [&](const double v)
  {
    const double h = 0.1;
    const auto Q   = [&](const double x) { return closed_form(preloaded, x, v).Q; };
    return (8. * (Q(h) - Q(-h)) - (Q(2. * h) - Q(-2. * h))) / (12. * h);
  };
  const double v = preloaded.drive.peak_speed();
  EXPECT_NEAR(lever_quantities(preloaded)[DesignQuantity::forward_slope], slope(v), 1e-7);
  EXPECT_NEAR(lever_quantities(preloaded)[DesignQuantity::backward_slope], slope(-v), 1e-7);
}

TEST(Design, FrontOfTwoAimsIsOfLeversThatNoneBeats)
{
  // Over R alone c and the ratio of the slopes both grow: every R is on the front.
  const Scene scene =
      design({ "Design/Free=Geometry/Cylinder radius = 10 ... 60", "Design/Demands=", "Design/Aim=maximise damping slope",
               "Design/Second aim=minimise slope ratio", "Design/Front points=5" });
  const auto front = pareto_front(DesignProblem(scene));
  ASSERT_EQ(front.size(), 5u);
  EXPECT_NEAR(front.front().parameters[0], 60., 0.06);
  EXPECT_NEAR(front.back().parameters[0], 10., 0.06);
  const auto ratio = [](const Proposal &lever) { return lever.quantities[DesignQuantity::slope_ratio]; };
  for (std::size_t i = 1; i < front.size(); ++i)
  {
    EXPECT_LT(ratio(front[i]), ratio(front[i - 1]));
    EXPECT_NEAR(ratio(front[0]) - ratio(front[i]), 0.25 * static_cast<double>(i) * (ratio(front[0]) - ratio(front[4])), 1e-3);
    const double theta = std::asin(front[i].parameters[0] / 200.);
    EXPECT_NEAR(front[i].quantities[DesignQuantity::damping_slope], damping_slope(5e4, 200., theta), 1e-9);
  }
}

TEST(Design, LargestRadiusWithinAReach)
{
  const auto found = best_design(design({ "Geometry/Pivot height=30", "Design/Free=Geometry/Cylinder radius = 35 ... 100",
                                          "Design/Demands=reach >= 150", "Design/Aim=maximise Geometry/Cylinder radius" }));
  ASSERT_TRUE(found.meets_all);
  // The circle about (x, 0) meets the pivot (200, -30) at x = 150.
  const double R = std::hypot(50., 30.);
  EXPECT_NEAR(found.lever.parameters[0], R, 1e-3 * R);
  EXPECT_NEAR(found.lever.quantities[DesignQuantity::reach], 150., 0.15);
}

TEST(Design, LargestBeginningWithinAResidualOffset)
{
  const Scene scene = design({ "Isolation/Mass=0.05", "Isolation/Stiffness=1.1", "Isolation/Levers=2", "Isolation/Damper=lever",
                               "Isolation/Base motion=none", "Isolation/Duration=3", "Isolation/Initial displacement=0.01",
                               "Design/Free=Isolation/Initial displacement = 1e-4 ... 0.1",
                               "Design/Demands=residual offset <= 1e-3", "Design/Aim=maximise Isolation/Initial displacement" });
  const auto found  = best_design(scene);
  ASSERT_TRUE(found.meets_all);
  // So close to z = 0 the table swings out on K + n C_Q forward and back on K + n C_Q backward, each for a quarter of that
  // period, and turns at r = sqrt((K + n C_Q backward)/(K + n C_Q forward)) of the last turn. At the end it is about the mean of
  // the last two.
  const double theta = std::asin(30. / 200.), c = damping_slope(5e4, 200., theta), k_e = c * std::tan(theta) / mu;
  const double out = 1.1 + 2. * (k_e + c), back = 1.1 + 2. * (k_e - c), r = std::sqrt(back / out);
  const double half  = 0.5 * M_PI * (std::sqrt(0.05 / out) + std::sqrt(0.05 / back));
  const double turns = std::floor(3. / half);
  const double z     = 1e-3 * 2. / (std::pow(r, turns - 1.) * (1. - r));
  EXPECT_NEAR(found.lever.parameters[0], z, 1e-3 * z);
  EXPECT_NEAR(found.lever.quantities[DesignQuantity::residual_offset], 1e-3, 1e-6);
}
