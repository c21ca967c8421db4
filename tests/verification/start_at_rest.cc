// SPDX-License-Identifier: GPL-3.0-only
#include "scene/closed_form.h"
#include "scene/scene.h"
#include "verification/meshed_in_time.h"
#include "verification/run_scene.h"

#include <cmath>
#include <gtest/gtest.h>

using namespace sprag;

namespace
{
  /// Stands still at x = 45 mm.
  std::vector<Drive> resting_drives()
  {
    return { Drive(DriveProfile::harmonic, 45., 65., 112., 0.1),
             Drive({ 0., 0.02, 0.03, 0.06, 0.08 }, { 45., 45., 45.1, 46., 46.5 }),
             Drive({ 0., 0.02, 0.03, 0.06, 0.08 }, { 45., 45., 44.9, 44., 43.5 }) };
  }

  Scene coarse(Scene scene)
  {
    scene.mesh.face_size  = 4.;
    scene.mesh.degree     = 1;
    scene.condensed.modes = 5;
    return scene;
  }

  Scene resting(const ModelType model, const Drive &drive)
  {
    return coarse(with_drive(in_time(model_a(), model), drive));
  }

  // Friction of mu at rest, as left by sliding there; the drive sets in so gently that nothing rings.
  void expect_calm_start(const Scene &scene)
  {
    const auto run   = run_any_in_time(scene);
    const Row &first = run.rows.front();
    EXPECT_NEAR(first[Column::mu], 0.3491, 1e-12);
    EXPECT_NEAR(first[Column::P], closed_form(scene, 45., 0.).P, 0.02 * first[Column::P]);
    EXPECT_NEAR(first[Column::F], 0.3491 * first[Column::P], 0.02 * first[Column::F]);
    EXPECT_NEAR(first[Column::P], first[Column::P_quasi_static], 1e-6 * first[Column::P]);
    EXPECT_EQ(first[Column::kinetic_energy], 0.);
    for (const Row &row : run.rows)
      if (row[Column::time] < 0.01)
      {
        EXPECT_NEAR(row[Column::P], first[Column::P], 0.05 * first[Column::P]) << row[Column::time];
      }
    EXPECT_LT(run.report.ledger.share(), 1e-3);
  }
} // namespace

TEST(StartAtRest, FurtherOnIsEquilibriumOfReducedLevers)
{
  for (const auto model : { ModelType::rigid, ModelType::beam })
    for (const auto &drive : resting_drives())
      expect_calm_start(resting(model, drive));
}

TEST(StartAtRest, FurtherOnIsEquilibriumOfMeshedLevers)
{
  for (const auto model : { ModelType::condensed, ModelType::finite_element })
    expect_calm_start(resting(model, resting_drives()[0]));
}

TEST(StartAtRest, FurtherOnIsEquilibriumOfAPairOnASprungSupport)
{
  Scene scene     = on_sprung_support(resting(ModelType::beam, resting_drives()[0]));
  scene.pair.type = PairType::full;
  expect_calm_start(scene);
}

// Without inertia the approach has the drive's own speed, none where it stands still.
TEST(StartAtRest, WithoutInertiaHasMuOfTheSpeedThere)
{
  Scene scene         = coarse(model_a());
  scene.drive         = Drive(DriveProfile::harmonic, 45., 65., 112., 0.05);
  scene.analysis.step = 1.;
  const auto rows     = run_scene(scene);
  EXPECT_NEAR(rows.front()[Column::mu], 0.3491, 1e-3);
  EXPECT_NEAR(rows.front()[Column::Q], rows.front()[Column::Q_closed_form], 0.05 * rows.front()[Column::Q]);
  // Speed rises with the root of the way: mu grows, by less than 0.01 in the first step.
  EXPECT_NEAR(rows.front()[Column::Q], rows[1][Column::Q], 0.1 * rows.front()[Column::Q]);

  scene.drive = Drive(DriveProfile::triangle, 45., 65., 112., 0.05);
  EXPECT_NEAR(run_scene(scene).front()[Column::mu], 0.7285, 0.01);
}
