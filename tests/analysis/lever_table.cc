#include "analysis/isolation/lever_table.h"
#include "base/errors.h"
#include "levers/dynamics.h"
#include "mpi_environment.h"
#include "run/transient_settings.h"
#include "support/isolated.h"

#include <gtest/gtest.h>

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

  IsolationFindings found_by(const Scene &scene)
  {
    DynamicsMaker maker(false, 2);
    const auto outward = maker.make(scene), inward = maker.make(scene);
    LeverTable table(scene, outward.model(), inward.model(), transient_settings(scene, {}));
    IsolationFindings found;
    run_isolation(scene, table, found, {});
    EXPECT_LT(table.iterations_a_step(), 3.);
    return found;
  }
} // namespace

TEST(LeverTable, LeversInTimeMoveTheTableAsTheClosedFormDoes)
{
  const auto expected = findings_of(on_levers(ModelType::closed_form));
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
  const auto expected                  = findings_of(scene);
  scene.analysis.model                 = ModelType::rigid;
  const auto found                     = found_by(scene);
  EXPECT_NEAR(found.fundamental / expected.fundamental, 1., 5e-3);
  EXPECT_NEAR(found.base_work, expected.base_work, 5e-3 * found.dissipated);
  EXPECT_LT(found.energy_residual, 1e-6);
}

TEST(LeverTable, AMotionBeyondTheWayOfTheLeversStopsTheRun)
{
  Scene scene                      = on_levers(ModelType::rigid);
  scene.isolation.initial_velocity = 600.;
  EXPECT_THROW(found_by(scene), AnalysisError);
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
