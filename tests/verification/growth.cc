// SPDX-License-Identifier: GPL-3.0-only
#include "input/read.h"
#include "scene/scene.h"
#include "support/params_folder.h"
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

  Growth compute_growth(const JudgedSlide &checked)
  {
    HeldRun run(checked.dynamics.model(), checked.step());
    return measure_growth(checked.dynamics.model(), checked.stability, checked.scene.sprag_slip, run, ignore);
  }

  /// Undamped steps turn lambda into lambda + lambda^3 dt^2 / 12 + O(dt^4): 6e-4 off the growth and 2e-4 off the frequency.
  std::complex<double> in_steps(const std::complex<double> lambda, const double dt)
  {
    return lambda * (1. + lambda * lambda * dt * dt / 12.);
  }

  void expect_as_predicted(const JudgedSlide &checked, const Growth &growth, const double growth_tolerance = 1e-4)
  {
    EXPECT_TRUE(growth.reached);
    EXPECT_TRUE(growth.slid);
    EXPECT_LT(std::abs(growth.growth_difference()), 0.03);
    EXPECT_LT(std::abs(growth.frequency_difference()), 0.005);
    // Left is what an amplitude of 1e-3 of the indentation makes of a contact that is not linear, and what the first steps excite
    // beside the mode: 1e-4 of the growth, and of the frequency as many times less as a radian is shorter than the window.
    const auto expected = in_steps(growth.eigenvalue, checked.step());
    EXPECT_NEAR(growth.envelope.rate, expected.real(), growth_tolerance * std::abs(expected.real()));
    EXPECT_NEAR(growth.frequency, expected.imag() / (2. * M_PI), 1e-5 * expected.imag() / (2. * M_PI));
    EXPECT_LT(growth.envelope.scatter, 1e-3);
  }

  /// Largest deviation of P from a slide that nothing perturbs, over P.
  double drift(const JudgedSlide &checked, const unsigned int steps)
  {
    HeldRun run(checked.dynamics.model(), checked.step());
    run.begin(checked.slide().motion);
    const auto path = held_path(run.drive(), checked.slide());
    double largest  = 0.;
    for (unsigned int i = 0; i < steps; ++i)
      largest = std::max(largest, std::abs(run.step(path)[Column::P] / checked.slide().forces.P - 1.));
    EXPECT_TRUE(run.slides(checked.slide().speed));
    return largest;
  }

  /// Cork on aluminium, whose mu rises with speed, with stick.
  Scene cork(Scene scene)
  {
    scene.friction = {};
    return scene;
  }

  /// The same, changing sign over 1 mm/s.
  Scene regularised_cork(Scene scene)
  {
    scene.friction                      = {};
    scene.friction.regularisation_speed = 1.;
    return scene;
  }
} // namespace

// The table turned on a circle whose centre stands still is an exact equilibrium of the steps: what is left is round-off of a
// displacement of some 30 mm, 30 * 1e-16 mm times 2000 N/mm = 1e-11 N, as often as it is taken up in 2000 steps.
TEST(HeldSlide, StaysWhereItIs)
{
  for (const auto type : { ModelType::rigid, ModelType::beam })
    for (const auto support : { SupportType::rigid, SupportType::sprung })
      for (const bool rises : { false, true })
      {
        Scene scene        = backward_a(type, 20.);
        scene.support.type = support;
        EXPECT_LT(drift(JudgedSlide(rises ? regularised_cork(scene) : scene), 2000), 1e-9) << static_cast<int>(type) << rises;
      }
}

// Levers that swing together neither move the frame nor bend the springs between them: on a sprung frame they sprag-slip where
// half of the pair, which can but mirror, is stable.
TEST(Growth, OfAPairThatSwingsWhereHalfOfItIsStable)
{
  Scene scene        = with_lever(in_time(model_a(), ModelType::beam), 7.15, 10577.8, 1.47073);
  scene.support.type = SupportType::sprung;
  scene              = held_at(scene, 65.);
  EXPECT_EQ(JudgedSlide(scene).stability.kind, SlideKind::stable);
  scene.pair.type = PairType::full;
  const JudgedSlide checked(scene);
  EXPECT_NEAR(checked.mode().symmetry, -1., 1e-6);
  EXPECT_NEAR(checked.mode().growth.friction_support, 0., 1e-6 * checked.mode().mode.eigenvalue.real());
  expect_predicted_growth(checked);
  // A held joint gives each lever its spring, but the frame still stays where it is.
  scene.pair.joint = SpringJoint::held;
  EXPECT_EQ(JudgedSlide(scene).stability.kind, SlideKind::flutter);
}

TEST(Growth, OfModelAIsThatOfItsEigenvalue)
{
  const JudgedSlide checked(backward_a(ModelType::beam, 6.));
  ASSERT_EQ(checked.stability.kind, SlideKind::flutter);
  expect_as_predicted(checked, compute_growth(checked));
}

TEST(Growth, OfACondensedLeverIsThatOfItsEigenvalue)
{
  const JudgedSlide checked(backward_a(ModelType::condensed, 6.));
  ASSERT_EQ(checked.stability.kind, SlideKind::flutter);
  // The start of Newton's method decides on the round-off of the first steps: 1.04e-4 from the line of the last two forces with
  // modes in axes that do not turn, 2.2e-4 in those of the hub.
  expect_as_predicted(checked, compute_growth(checked), 4e-4);
}

TEST(Growth, OfAStableSlideIsItsDecay)
{
  for (const auto type : { ModelType::rigid, ModelType::beam })
    for (const auto support : { SupportType::rigid, SupportType::sprung })
    {
      Scene scene        = backward_a(type, 20.);
      scene.support.type = support;
      const JudgedSlide checked(scene);
      ASSERT_EQ(checked.stability.kind, SlideKind::stable);
      const auto growth = compute_growth(checked);
      EXPECT_LT(growth.envelope.rate, 0.);
      EXPECT_TRUE(growth.reached);
      EXPECT_LT(std::abs(growth.growth_difference()), 0.03) << static_cast<int>(type) << static_cast<int>(support);
      EXPECT_LT(std::abs(growth.frequency_difference()), 0.005) << static_cast<int>(type) << static_cast<int>(support);
    }
}

// Plain mu(v): the spring of stick delays what mu does with the slip, in the steps as in the eigenvalue.
TEST(Growth, UnderALawThatRisesWithSpeedIsThatOfItsEigenvalue)
{
  for (const auto type : { ModelType::rigid, ModelType::beam, ModelType::condensed })
  {
    const JudgedSlide checked(cork(backward_a(type, 6.)));
    const JudgedSlide constant(backward_a(type, 6.));
    const auto growth = compute_growth(checked);
    EXPECT_TRUE(growth.reached);
    EXPECT_TRUE(growth.slid);
    EXPECT_LT(std::abs(growth.growth_difference()), 3e-3) << static_cast<int>(type);
    EXPECT_LT(std::abs(growth.frequency_difference()), 1e-3) << static_cast<int>(type);
    EXPECT_GT(std::abs(checked.stability.growth_rate() / constant.stability.growth_rate() - 1.), 0.02);
  }
}

namespace
{
  /// A run on the true drive, slowly backward from the held x, perturbed along a mode by an amplitude over the indentation.
  Motion driven(const JudgedSlide &checked, const DrivePoint &start, const double amplitude)
  {
    auto &model      = checked.dynamics.model();
    const auto held  = checked.slide().motion;
    const auto mode  = model.perturbed(checked.slide(), checked.mode(), amplitude * checked.slide().penetration);
    Motion motion    = model.initial_motion(start);
    const auto added = [](dealii::Vector<double> &to, const dealii::Vector<double> &with, const dealii::Vector<double> &less)
    {
      to += with;
      to -= less;
    };
    added(motion.coordinates.position, mode.coordinates.position, held.coordinates.position);
    added(motion.coordinates.velocity, mode.coordinates.velocity, held.coordinates.velocity);
    added(motion.coordinates.acceleration, mode.coordinates.acceleration, held.coordinates.acceleration);
    if (motion.face_force.size() > 0)
      added(motion.face_force, mode.face_force, held.face_force);
    return motion;
  }

  /// P of a perturbed run less that of its twin in the same steps, from the perturbation's initial to its final amplitude.
  std::vector<Sample> twin_difference(const JudgedSlide &checked, const double speed, double &travel)
  {
    const auto &settings = checked.scene.sprag_slip;
    auto &model          = checked.dynamics.model();
    const DrivePoint start{ 0., checked.slide().drive.x, -speed, 0., 0. };
    const auto drive = [&](const double time) -> DrivePoint { return { time, start.x - speed * time, -speed, 0., 0. }; };
    HeldRun perturbed(model, checked.step()), twin(model, checked.step());
    perturbed.begin(driven(checked, start, settings.initial));
    twin.begin(driven(checked, start, 0.));
    const double rate     = checked.stability.growth_rate();
    const double duration = std::log(settings.final / settings.initial) / rate;
    std::vector<Sample> signal;
    for (double time = 0.; time < duration; time += checked.step())
    {
      const double P = perturbed.step(drive)[Column::P];
      signal.push_back({ time, P - twin.step(drive)[Column::P] });
      EXPECT_TRUE(perturbed.slides(-speed));
    }
    travel = speed * duration;
    signal.erase(signal.begin(), signal.begin() + 2 * settings.steps_per_period);
    return signal;
  }
} // namespace

// On the drive itself, so slow that x hardly moves, and fast enough that the perturbation does not stop the slip: 0.6 mm/s.
TEST(Growth, OnACreepingDriveIsThatOfItsEigenvalue)
{
  constexpr double speed = 0.6;
  for (const auto &scene : { backward_a(ModelType::beam, 6.), backward_b(), backward_a(ModelType::condensed, 6.) })
  {
    Scene slow = scene;
    slow.drive = Drive(DriveProfile::triangle, 0., 65., speed, 1.);
    const JudgedSlide checked(slow);
    double travel      = 0.;
    const auto signal  = twin_difference(checked, speed, travel);
    const auto fit     = fit_exponential(compute_envelope(signal));
    const auto lambda  = checked.mode().mode.eigenvalue;
    const double found = fit_frequency(crossings(signal));
    EXPECT_LT(travel, 0.05);
    EXPECT_NEAR(fit.rate, lambda.real(), 0.03 * lambda.real());
    EXPECT_NEAR(found, lambda.imag() / (2. * M_PI), 0.005 * lambda.imag() / (2. * M_PI));
    // The perturbation grows through all of the window, by more than 100 in amplitude.
    const auto sizes = compute_envelope(signal);
    EXPECT_GT(sizes.back().value / sizes.front().value, 100.);
  }
}
