// SPDX-License-Identifier: GPL-3.0-only
#include "analysis/limit_cycle/limit_cycle.h"
#include "input/read.h"
#include "scene/scene.h"
#include "support/shipped.h"
#include "verification/held_slides.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

using namespace sprag;

namespace
{
  void ignore(const Row &)
  {
  }

  Scene beam_at_onset(const std::string &depth)
  {
    return shipped("onset-a", { "Friction/Coefficient=0.6", "Lever/Depth=" + depth });
  }

  /// Returns the attractor to which a growing perturbation leads.
  Settled settle_between(const JudgedSlide &checked, const double shortest, const double longest)
  {
    const auto &settings = checked.scene.sprag_slip;
    HeldRun run(checked.dynamics.model(), checked.step());
    measure_growth(checked.dynamics.model(), checked.stability, settings, run, ignore);
    run.spectral_radius = checked.scene.time.spectral_radius;
    return settle(run, checked.slide(), { checked.step() * settings.steps_per_period, shortest, longest }, ignore);
  }

  /// Returns the attractor to which a kick of the slide leads.
  Settled after_kick(const JudgedSlide &checked, const double kick, HeldRun &run)
  {
    run.spectral_radius = checked.scene.time.spectral_radius;
    run.begin(checked.dynamics.model().perturbed(checked.slide(), checked.mode(), kick * checked.slide().penetration));
    const double period = checked.step() * checked.scene.sprag_slip.steps_per_period;
    return settle(run, checked.slide(), { period, checked.scene.sprag_slip.settling, 2. }, ignore);
  }

  Settled after_kick(const JudgedSlide &checked, const double kick)
  {
    HeldRun run(checked.dynamics.model(), checked.step());
    return after_kick(checked, kick, run);
  }

  Scene with_steps(Scene scene, const unsigned int per_period)
  {
    scene.sprag_slip.steps_per_period = per_period;
    return scene;
  }

  std::vector<ErrorEstimate> compute_errors(const JudgedSlide &checked, const HeldRun &run, const Settled &found)
  {
    const double period = checked.step() * checked.scene.sprag_slip.steps_per_period;
    return estimate_cycle_errors(checked.dynamics.model(), run, checked.slide(), found, period);
  }

  /// Compares the estimated errors of a cycle in 128 steps a period with those against 1024.
  void expect_true_errors(const Scene &scene)
  {
    const JudgedSlide checked(scene);
    HeldRun run(checked.dynamics.model(), checked.step());
    const auto found  = after_kick(checked, 1e-3, run);
    const auto errors = compute_errors(checked, run, found);
    ASSERT_EQ(found.kind, Settling::cycle);
    const auto finely      = after_kick(JudgedSlide(with_steps(scene, 1024)), 1e-3).window;
    const double amplitude = std::abs(found.window.amplitude_P / finely.amplitude_P - 1.);
    const double frequency = std::abs(found.window.frequency / finely.frequency - 1.);
    EXPECT_GT(amplitude, 1e-3);
    EXPECT_GT(total_error(errors[0]), 0.5 * amplitude);
    EXPECT_LT(total_error(errors[0]), 3. * amplitude);
    EXPECT_GT(total_error(errors[1]), 0.5 * frequency);
    EXPECT_LT(total_error(errors[1]), 3. * frequency);
  }
} // namespace

// An attractor does not depend on where it is approached from, nor on the step: 128 a period err by 2 %/100 of the frequency, and
// by less than 1 % of impacts that last half a period.
TEST(LimitCycle, IsTheSameFromBelowAndAboveAndInShorterSteps)
{
  const auto below  = after_kick(JudgedSlide(backward_b()), 1e-3);
  const auto above  = after_kick(JudgedSlide(backward_b()), 5.);
  const auto finely = after_kick(JudgedSlide(with_steps(backward_b(), 256)), 1e-3);
  for (const auto *found : { &below, &above, &finely })
  {
    ASSERT_EQ(found->kind, Settling::cycle);
    EXPECT_GT(found->window.open_share, 0.1);
    EXPECT_NEAR(found->window.amplitude_P, below.window.amplitude_P, 0.01 * below.window.amplitude_P);
    EXPECT_NEAR(found->window.amplitude_indentation, below.window.amplitude_indentation,
                0.01 * below.window.amplitude_indentation);
    EXPECT_NEAR(found->window.frequency, below.window.frequency, 1e-3 * below.window.frequency);
    EXPECT_NEAR(found->window.open_share, below.window.open_share, 0.02);
  }
  // P swings from 0: its amplitude is half of its peak; without contact the indentation is none.
  EXPECT_GT(below.window.amplitude_P, 14. / 2.);
}

TEST(LimitCycle, TellsItsErrorSlow)
{
  const std::vector<std::vector<std::string>> devices = {
    { "Lever/Depth=7.5" },
    { "Lever/Depth=8" },
    { "Lever/Depth=7", "Friction/Law=cork on aluminium" },
    { "Lever/Depth=11", "Stability/Position=40", "Stability/Direction=forward" },
    { "Lever/Depth=6.5", "Geometry/Interface offset=35" },
  };
  for (const auto &device : devices)
  {
    SCOPED_TRACE(device.back());
    expect_true_errors(shipped("onset-a", device));
  }
}

// After 6 s the same P comes back after eight vibrations. For half a second nearly the same comes back after four, with a
// difference that doubles from window to window.
TEST(LimitCycle, ThatIsAboutToDoubleItsPeriodIsNone)
{
  const JudgedSlide checked(beam_at_onset("6.8"));
  for (const double shortest : { 0.7, 0.9, 1.1, 1.3 })
  {
    const auto found = settle_between(checked, shortest, 6.);
    EXPECT_EQ(found.kind, Settling::cycle) << shortest;
    EXPECT_EQ(found.window.vibrations(), 8.) << shortest;
  }
}

// Windows of a cycle scatter: one look at the end may not find three that agree.
TEST(LimitCycle, IsLookedForMoreThanOnce)
{
  for (const char *depth : { "7", "7.5", "8" })
    EXPECT_EQ(settle_between(JudgedSlide(beam_at_onset(depth)), 2., 2.).kind, Settling::cycle) << depth;
}

// Friction that falls within 10 mm/s and 1e-4 mm of path lets the slip run away at 3.45e4 1/s. In steps of that rate, 1.4e6 of
// them, no window held one of the vibrations. In four times as many steps a vibration the amplitude is 30.61 N, the frequency
// 252.5 Hz.
TEST(LimitCycle, OfADivergenceIsFoundInItsOwnTime)
{
  const JudgedSlide checked(shipped("stability-a", { "Analysis/Type=sprag slip", "Analysis/Model=rigid", "Friction/Law=Stribeck",
                                                     "Friction/Static coefficient=2.5", "Friction/Stribeck speed=10",
                                                     "Friction/Memory length=1e-4", "Drive/Speed=50" }));
  ASSERT_EQ(checked.stability.kind, SlideKind::divergence);
  const auto &settings = checked.scene.sprag_slip;
  const auto cycle     = choose_cycle_steps(checked.stability, settings);
  HeldRun run(checked.dynamics.model(), checked.step());
  measure_growth(checked.dynamics.model(), checked.stability, settings, run, ignore);
  run.spectral_radius = checked.scene.time.spectral_radius;
  run.dt              = cycle.dt;
  const auto found    = settle(run, checked.slide(), { cycle.period, settings.settling, settings.settling }, ignore);
  EXPECT_NEAR(found.window.amplitude_P, 30.61, 0.03 * 30.61);
  EXPECT_NEAR(found.window.frequency, 252.5, 0.03 * 252.5);
  EXPECT_LT(run.steps(), 200000u);
}

// Friction and damping take what the turning cylinder gives, over whole cycles and with everything that opens and sticks.
TEST(LimitCycle, ClosesTheLedger)
{
  const JudgedSlide checked(backward_a(ModelType::beam, 6.));
  HeldRun run(checked.dynamics.model(), checked.step());
  EXPECT_TRUE(after_kick(checked, 1., run).vibrates());
  EXPECT_LT(run.ledger().share(), 1e-6);
  EXPECT_GT(run.ledger().largest_work, 100.);
}

// Model B backward loses its stability between x = 41 and 42 and keeps the cycle that lives there down to below x = 40.
TEST(Continuation, FindsWhereASlideAndACycleCoexistSlow)
{
  Scene scene                   = backward_b();
  scene.sprag_slip.continuation = 6;
  const JudgedSlide checked(scene);
  HeldRun run(checked.dynamics.model(), checked.step());
  const auto start     = after_kick(checked, 1e-3, run);
  const auto &settings = scene.sprag_slip;
  const SettlingTimes times{ checked.step() * settings.steps_per_period, settings.settling,
                             std::max(settings.settling, settings.longest_growth) };
  Continuation continuation(checked.dynamics.model(), run, held_drive(scene), times, with_shapes(checked_modes(scene)), settings);
  unsigned int calls = 0;
  continuation.go(checked.stability, start, 38., [&] { ++calls; });
  EXPECT_GE(calls, 13u);
  EXPECT_LT(run.ledger().share(), 1e-6);

  const auto found = continuation.coexistence();
  ASSERT_TRUE(found);
  EXPECT_EQ(checked.checked_at(found->to - 2e-3).kind, SlideKind::stable);
  EXPECT_EQ(checked.checked_at(found->to + 2e-3).kind, SlideKind::flutter);
  EXPECT_LT(found->from, 40.);

  // Without continuation: at one x inside a small perturbation dies and a large one does not, and it is the same cycle.
  const JudgedSlide inside(held_at(scene, 41.));
  EXPECT_EQ(after_kick(inside, Continuation::small_kick).kind, Settling::slide);
  const auto &points = continuation.points();
  const auto at_41 = std::find_if(points.begin(), points.end(), [](const auto &point) { return std::abs(point.x - 41.) < 1e-9; });
  ASSERT_NE(at_41, points.end());
  EXPECT_TRUE(at_41->coexist());
  EXPECT_EQ(at_41->back.kind, Settling::slide);
  const auto kicked = after_kick(inside, 2.);
  EXPECT_TRUE(kicked.vibrates());
  EXPECT_NEAR(at_41->away.window.amplitude_P, kicked.window.amplitude_P, 0.01 * kicked.window.amplitude_P);
  // Beyond its death only the slide is left.
  EXPECT_EQ(points.back().away.kind, Settling::slide);
}
