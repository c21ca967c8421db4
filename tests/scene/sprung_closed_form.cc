// SPDX-License-Identifier: GPL-3.0-only
#include "scene/sprung_closed_form.h"

#include "scene/scene.h"
#include "scenes.h"
#include "support/scene_parts.h"

#include <cmath>
#include <gtest/gtest.h>

using namespace sprag;

namespace
{
  constexpr double v = 112.;
} // namespace

TEST(SprungClosedForm, TheFramesSpringBalancesQ)
{
  for (const Scene &scene : { on_sprung_support(model_a(), 50.), on_sprung_support(model_b(), 20.) })
  {
    SprungClosedForm lever(scene);
    lever.start(0., v);
    for (double x = 1.; x <= 65.; x += 1.)
    {
      const auto &state = lever.advance(x, v);
      EXPECT_FALSE(state.sticks);
      EXPECT_NEAR(scene.support.stiffness * state.displacement, state.lever.Q, 1e-10);
      // Coulomb's law would make this exact; mu(v) follows the slower slip, which is 1 / (1 + Q_x / k_f) of v.
      const auto rigid = closed_form(scene, x - state.displacement, v);
      EXPECT_NEAR(state.lever.contact.theta, rigid.contact.theta, 1e-13);
      EXPECT_NEAR(state.lever.P, rigid.P, 2e-2 * rigid.P);
      EXPECT_LT(state.lever.v_rel, rigid.v_rel);
    }
  }
}

TEST(SprungClosedForm, AReversalSticksUntilFrictionHasTurned)
{
  const auto scene = with_coulomb(on_sprung_support(model_a(), 100.), 0.7);
  SprungClosedForm lever(scene);
  lever.start(0., v);
  const auto turning  = lever.advance(65., v);
  const double from   = 65. - turning.displacement;
  const double travel = (closed_form(scene, from, v).Q - closed_form(scene, from, -v).Q) / 100.;

  const auto before = lever.advance(65. - 0.999 * travel, -v);
  EXPECT_TRUE(before.sticks);
  EXPECT_EQ(before.work.friction, turning.work.friction);
  // Inside the cone, near the backward edge, and in balance of moments: M = P s + F e.
  EXPECT_LT(std::abs(before.lever.F), 0.7 * before.lever.P);
  EXPECT_NEAR(before.lever.F / before.lever.P, -0.7, 5e-3);
  const double moment = scene.spring.stiffness * (turning.lever.contact.theta - kinematics(scene.geometry, 0.).theta);
  EXPECT_NEAR(before.lever.P * before.lever.contact.s + before.lever.F * 45.6, moment, 1e-9 * moment);

  const auto after = lever.advance(65. - 1.001 * travel, -v);
  EXPECT_FALSE(after.sticks);
  EXPECT_NEAR(after.lever.F / after.lever.P, -0.7, 1e-12);
}

TEST(SprungClosedForm, TheDrivesWorkIsStoredOrDissipated)
{
  const auto scene  = on_sprung_support(model_a(), 30.);
  const auto energy = [&](const SprungClosedForm::State &state)
  {
    const double turn = state.lever.contact.theta - kinematics(scene.geometry, 0.).theta;
    return state.support_energy + 0.5 * scene.spring.stiffness * turn * turn;
  };
  SprungClosedForm lever(scene);
  auto state           = lever.start(10., v);
  const double initial = energy(state);
  const auto follow    = [&](const double from, const double to, const double speed)
  {
    for (unsigned int i = 1; i <= 130; ++i)
      state = lever.advance(from + (to - from) * i / 130., speed);
    EXPECT_NEAR(state.work.drive, state.work.friction + energy(state) - initial, 1e-8 * state.work.drive);
  };
  follow(10., 65., v);
  follow(65., 20., -v);
  follow(20., 40., v);
}
