// SPDX-License-Identifier: GPL-3.0-only
#include "scene/pair_closed_form.h"

#include "scene/mirrored_pair.h"
#include "scene/scene.h"
#include "scenes.h"
#include "support/scene_parts.h"

#include <cmath>
#include <functional>
#include <gtest/gtest.h>

using namespace sprag;

namespace
{
  constexpr SpringJoint joints[] = { SpringJoint::held, SpringJoint::free };

  /// Both joints, linear springs and hardening ones, cork and constant friction.
  std::vector<Scene> pairs(const double offset, const double friction_ratio)
  {
    Scene hardening  = with_coulomb(model_a(), 0.73);
    hardening.spring = with_cubic_hardening(7.4e4, 300.);
    std::vector<Scene> result;
    for (const auto joint : joints)
      for (const Scene &scene : { model_a(), model_b(), with_friction_by_drive_speed(model_a()), hardening })
        result.push_back(paired(scene, joint, offset, friction_ratio));
    return result;
  }

  double spring_energy(const Scene &scene, const double x)
  {
    const auto levers = pair_closed_form(scene, x, 1.);
    return levers[0].spring_energy + levers[1].spring_energy;
  }

  double drive_force(const Scene &scene, const double x, const double v)
  {
    const auto levers = pair_closed_form(scene, x, v);
    return levers[0].state.Q + levers[1].state.Q;
  }

  /// On the cylinder, towards the first lever: both push it away from themselves, along n of each.
  double lateral_force(const Scene &scene, const double x)
  {
    const auto levers = pair_closed_form(scene, x, 1.);
    const auto pushed = [](const ClosedFormState &lever)
    { return lever.P * std::cos(lever.contact.theta) - lever.F * std::sin(lever.contact.theta); };
    return pushed(levers[1].state) - pushed(levers[0].state);
  }

  /// Five points: errs by h^4/30 f^(5), a few 1e-12 of f' for functions that vary over 100 mm, plus round-off of 1e-15 f/(h f').
  double derivative(const std::function<double(double)> &f, const double x)
  {
    const double h = 0.1;
    return (f(x - 2. * h) - 8. * f(x - h) + 8. * f(x + h) - f(x + 2. * h)) / (12. * h);
  }

  double turn(const Scene &scene, const double theta)
  {
    return theta - kinematics(scene.geometry, 0.).theta;
  }
} // namespace

// Eq. 9 with the cylinder's centre off the mirror plane: nearer to the pivot of the first lever by as much as it is farther from
// that of the second.
TEST(PairClosedForm, BothLeversTouchTheCylinderWhereverItIs)
{
  const double offset = 0.5;
  for (const Scene &scene : pairs(offset, 1.))
    for (const double x : { 30., 65. })
    {
      const auto &g    = scene.geometry;
      const auto theta = pair_inclinations(scene, x);
      for (const auto &[inclination, height] : { std::pair{ theta[0], -offset }, { theta[1], offset } })
        EXPECT_NEAR((g.pivot_distance - x) * std::sin(inclination) + height * std::cos(inclination),
                    g.cylinder_radius - g.interface_offset, 1e-12);
    }
}

TEST(PairClosedForm, AFreeJointGivesBothLeversTheMomentOfTheirMeanTurn)
{
  for (const double ratio : { 1., 0.8 })
    for (const Scene &scene : pairs(0.5, ratio))
      if (swings(scene))
        for (const double v : { 112., -112. })
        {
          const auto [first, second] = pair_closed_form(scene, 40., v);
          const double mean          = 0.5 * (turn(scene, first.state.contact.theta) + turn(scene, second.state.contact.theta));
          const double moment        = moment_law(scene.spring).moment(mean);
          for (const auto &state : { first.state, second.state })
            EXPECT_NEAR(state.P * state.contact.s + state.F * scene.geometry.interface_offset, moment, 1e-12 * moment);
          EXPECT_NEAR(second.state.mu / first.state.mu, ratio, 1e-3); // mu by each lever's own sliding speed
        }
}

TEST(PairClosedForm, AHeldJointLeavesEachLeverItsOwnSpring)
{
  for (const Scene &scene : pairs(0.5, 0.8))
    if (!swings(scene))
      for (const auto &lever : pair_closed_form(scene, 40., -112.))
      {
        const double moment = moment_law(scene.spring).moment(turn(scene, lever.state.contact.theta));
        EXPECT_NEAR(lever.state.P * lever.state.contact.s + lever.state.F * scene.geometry.interface_offset, moment,
                    1e-12 * moment);
      }
}

// Virtual work without friction: the springs' energy over x and over the offset.
TEST(PairClosedForm, WithoutFrictionForcesAreTheDerivativesOfTheSpringsEnergy)
{
  for (const Scene &pair_scene : pairs(0.5, 1.))
  {
    const Scene scene = with_coulomb(pair_scene, 0.);
    const double x    = 40.;
    const double Q    = drive_force(scene, x, 1.);
    EXPECT_NEAR(Q, derivative([&](const double at) { return spring_energy(scene, at); }, x), 1e-9 * Q);

    const auto by_offset = [&](const double offset)
    {
      Scene moved                = scene;
      moved.pair.cylinder_offset = offset;
      return spring_energy(moved, x);
    };
    const double Y = lateral_force(scene, x);
    EXPECT_NEAR(Y, -derivative(by_offset, scene.pair.cylinder_offset), 1e-9 * (Q + std::abs(Y)));
    if (swings(scene))
      EXPECT_LT(std::abs(Y), 1e-2 * Q); // the pair follows the cylinder
    else
      EXPECT_LT(Y, -0.1 * Q); // each spring drives it back to the middle
  }
}

TEST(PairClosedForm, ALeverThatACylinderOffTheMiddleDoesNotReachRestsWithAHeldJoint)
{
  const double offset = 0.5;
  const Scene scene   = paired(model_a(), SpringJoint::held, offset);
  const Geometry &g   = scene.geometry;
  const double rest   = kinematics(g, 0.).theta;
  const double reached_at =
      g.pivot_distance - (g.cylinder_radius - g.interface_offset - offset * std::cos(rest)) / std::sin(rest);
  ASSERT_GT(reached_at, 5.);

  const auto before = pair_closed_form(scene, reached_at - 0.1, 1.);
  EXPECT_GT(before[0].state.P, 0.);
  EXPECT_FALSE(before[1].touches);
  EXPECT_EQ(before[1].state.P, 0.);
  EXPECT_EQ(before[1].state.Q, 0.);
  EXPECT_EQ(before[1].state.contact.theta, rest);
  EXPECT_EQ(before[1].spring_energy, 0.);
  const auto after = pair_closed_form(scene, reached_at + 0.1, 1.);
  EXPECT_TRUE(after[1].touches);
  EXPECT_GT(after[1].state.P, 0.);

  // The other way round it is the first.
  const auto mirrored = pair_closed_form(paired(model_a(), SpringJoint::held, -offset), reached_at - 0.1, 1.);
  EXPECT_EQ(mirrored[1].state.P, before[0].state.P);
  EXPECT_FALSE(mirrored[0].touches);
}

// A cylinder off the middle needs less room, by some offset^2 / l^2: at x = 0 the springs are not quite reached.
TEST(PairClosedForm, LeversThatSwingTogetherStandClearAtTheStartAndPressAtOnce)
{
  const Scene scene = paired(model_a(), SpringJoint::free, 0.5);
  const auto start  = pair_closed_form(scene, 0., 1.);
  const auto theta  = pair_inclinations(scene, 0.);
  for (const auto &lever : start)
  {
    EXPECT_FALSE(lever.touches);
    EXPECT_EQ(lever.state.P, 0.);
    EXPECT_EQ(lever.spring_energy, 0.);
  }
  EXPECT_NEAR(turn(scene, theta[0]) + turn(scene, theta[1]), 0., 1e-15);
  const auto &g = scene.geometry;
  EXPECT_NEAR(turn(scene, theta[0]), 0.5 / (g.pivot_distance * std::cos(theta[0])), 1e-5);
  for (const auto &lever : pair_closed_form(scene, 0.01, 1.))
    EXPECT_GT(lever.state.P, 0.);
}
