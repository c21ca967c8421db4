// SPDX-License-Identifier: GPL-3.0-only
#include "analysis/isolation/lever_table.h"

#include "analysis/transient/transient.h"
#include "base/errors.h"
#include "base/text.h"
#include "levers/dynamics.h"
#include "mpi_environment.h"
#include "scene/scene.h"
#include "support/isolated.h"
#include "support/thrown.h"

#include <cmath>
#include <gtest/gtest.h>
#include <random>
#include <set>

using namespace sprag;

// Levers in time under a table against those of the closed form, where their inertia and flexure hardly matter.

namespace
{
  Scene on_levers(const ModelType model)
  {
    Scene scene                          = isolated(DamperType::lever);
    scene.analysis.model                 = model;
    scene.isolation.initial_displacement = 50.;
    scene.isolation.duration             = 3.;
    return scene;
  }

  Scene on_closed_form(Scene scene)
  {
    scene.analysis.model = ModelType::closed_form;
    return scene;
  }

  IsolationFindings found_by(const Scene &scene)
  {
    DynamicsMaker maker(false, 2);
    const auto outward = maker.make(scene), inward = maker.make(scene);
    LeverTable table(scene, outward.model(), inward.model(), transient_settings(scene, {}));
    IsolationFindings found;
    run_isolation(scene, table, found, {});
    EXPECT_LT(table.iterations_a_step(), 1.2);
    return found;
  }

  /// Takes steps of random length through spans of 0.01 s and returns their durations.
  std::set<double> step_durations(StepGrid grid)
  {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> exponent(-12., 0.);
    std::set<double> durations;
    double time = 0.3;
    for (unsigned int span = 0; span < 200; ++span)
    {
      const double end = 0.3 + 0.01 * (span + 1);
      EXPECT_TRUE(grid.needs_span(end));
      grid.begin(time, end, 5e-4);
      for (double last = time; !grid.is_finished(); last = time)
      {
        const double target = 5e-4 * std::exp2(exponent(random));
        grid.choose(target);
        EXPECT_LE(grid.duration(), target * (1. + 1e-6));
        time = grid.step_end();
        EXPECT_NEAR(time - last, grid.duration(), 1e-8 * grid.duration() + 1e-15);
        durations.insert(grid.duration());
        grid.advance();
      }
      EXPECT_EQ(time, end);
      EXPECT_TRUE(grid.needs_span(end));
    }
    return durations;
  }
} // namespace

TEST(LeverTable, LeversInTimeMoveTheTableAsTheClosedFormDoes)
{
  const auto expected = compute_findings(on_levers(ModelType::closed_form));
  for (const auto model : { ModelType::rigid, ModelType::beam })
  {
    const auto found = found_by(on_levers(model));
    EXPECT_EQ(found.turns, expected.turns);
    EXPECT_NEAR(found.dissipated / expected.dissipated, 1., 5e-3);
    EXPECT_NEAR(found.rms_acceleration / expected.rms_acceleration, 1., 5e-3);
    EXPECT_LT(found.energy_residual, 1e-6);
  }
}

TEST(LeverTable, TheWayOutAndTheWayBackAreAlike)
{
  Scene scene                          = on_levers(ModelType::rigid);
  scene.isolation.duration             = 1.5;
  const auto out                       = found_by(scene);
  scene.isolation.initial_displacement = -50.;
  const auto back                      = found_by(scene);
  EXPECT_EQ(out.turns, back.turns);
  EXPECT_NEAR(out.residual_offset, -back.residual_offset, 1e-7);
  EXPECT_NEAR(out.dissipated, back.dissipated, 1e-6 * out.dissipated);
}

TEST(LeverTable, AHarmonicBaseMovesItAsTheClosedFormSays)
{
  Scene scene                          = on_levers(ModelType::closed_form);
  scene.isolation.base                 = BaseMotionType::harmonic;
  scene.isolation.base_amplitude       = 5.;
  scene.isolation.base_frequency       = 2.;
  scene.isolation.initial_displacement = 0.;
  const auto expected                  = compute_findings(scene);
  scene.analysis.model                 = ModelType::rigid;
  const auto found                     = found_by(scene);
  EXPECT_NEAR(found.fundamental / expected.fundamental, 1., 5e-3);
  EXPECT_NEAR(found.base_work, expected.base_work, 5e-3 * found.dissipated);
  EXPECT_LT(found.energy_residual, 1e-6);
}

TEST(LeverTable, AMotionBeyondTheWayOfTheLeversStopsTheRunAndSaysHowFarItGoes)
{
  Scene scene                      = on_levers(ModelType::rigid);
  scene.isolation.initial_velocity = 320.;
  const double largest             = compute_findings(on_closed_form(scene)).largest_displacement;
  ASSERT_GT(largest, scene.drive.maximum());
  const auto text            = thrown_text<AnalysisError>([&] { found_by(scene); });
  const std::string expected = "Try Drive/Stroke = " + rounded_text(std::ceil(1.1 * largest)) + ",";
  EXPECT_NE(text.find(expected), std::string::npos) << text << '\n' << expected;
}

TEST(LeverTable, ThinLeversSpragSlipUnderATable)
{
  const auto variation = [](const double depth)
  {
    Scene scene                          = on_levers(ModelType::beam);
    scene.isolation.stiffness            = 1.1;
    scene.lever.depth                    = depth;
    scene.isolation.duration             = 0.25;
    scene.isolation.output_step          = 2e-4;
    scene.isolation.initial_displacement = 64.;
    DynamicsMaker maker(false, 2);
    const auto outward = maker.make(scene), inward = maker.make(scene);
    LeverTable table(scene, outward.model(), inward.model(), transient_settings(scene, {}));
    IsolationFindings found;
    double sum = 0., last = table.damper_force();
    run_isolation(scene, table, found,
                  [&](const IsolatedTable &now, bool)
                  {
                    sum += std::abs(now.damper_force() - last);
                    last = now.damper_force();
                  });
    return sum;
  };
  EXPECT_LT(variation(20.), 100.);
  EXPECT_GT(variation(6.), 600.);
}

TEST(StepGrid, StepsOfAnyLengthMeetTheEndInFewDurations)
{
  StepGrid grid;
  EXPECT_LE(step_durations(grid).size(), 26u); // 1, 2, 3, 4, 6, 8 ... 4096, 6144 parts
  grid.use_halves_alone();
  EXPECT_LE(step_durations(grid).size(), 14u); // 1, 2, 4, 8 ... 8192 parts
}

TEST(StepGrid, ShorterStepsAreBetweenHalfAndTwoThirds)
{
  StepGrid grid;
  grid.begin(0., 1., 1.);
  for (unsigned int i = 0; i < 20; ++i)
  {
    const double before = grid.duration();
    grid.shorten();
    EXPECT_LE(grid.duration(), before * (2. / 3. + 1e-6));
    EXPECT_GE(grid.duration(), before * (0.5 - 1e-6));
    if (i % 3 == 0)
      grid.advance();
  }
}
