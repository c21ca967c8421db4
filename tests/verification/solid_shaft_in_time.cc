// SPDX-License-Identifier: GPL-3.0-only
#include "levers/dynamics.h"
#include "scene/held_slide.h"
#include "scene/scene.h"
#include "verification/held_slides.h"
#include "verification/solid_run.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

// A rigid cylinder whose axis yields on its shaft, in time and about held slides.

using namespace sprag;

namespace
{
  constexpr std::size_t tilt_column = 5, skew_column = 6; ///< among those across

  /// Out of true both ways on a shaft that yields by a good part of that, with one penalty whatever the analysis.
  Scene yielding(const AnalysisType type)
  {
    Scene scene                   = tilted(solid_model_a(0.), 4e-4, 2e-3);
    scene.cylinder.tilt_stiffness = 4e5;
    scene.cylinder.skew_stiffness = 1e5;
    scene.mesh.elements_across    = 2;
    scene.analysis.type           = type;
    scene.analysis.model          = type == AnalysisType::quasi_static ? ModelType::finite_element : ModelType::condensed;
    scene.condensed.modes         = 12;
    scene.contact.enforcement     = Enforcement::penalty;
    scene.contact.penalty         = 240.;
    scene.stability.critical      = "none";
    scene.stability.position      = 30.;
    scene.friction.law            = CoulombFriction{ 0.73 }; // which nothing delays, see linearise()
    return scene;
  }

  TransientRun run_solid_in_time(const Scene &scene)
  {
    DynamicsMaker maker(false);
    const auto dynamics = maker.make(scene);
    return run_in_time(dynamics.model(), scene);
  }
} // namespace

// Modes answer statically what they leave out. What slides slowly has hardly any inertia; the steps without inertia are those of
// another friction history, of which the elastic slip is left.
TEST(SolidShaftInTime, ASlideComesToTheStaticAnswer)
{
  Scene without        = yielding(AnalysisType::quasi_static);
  without.drive        = Drive(DriveProfile::triangle, 0., 24., 112., 0.5);
  const auto expected  = SolidRun(without).rows.back();
  Scene in_time        = yielding(AnalysisType::transient);
  in_time.drive        = Drive(DriveProfile::triangle, 23.5, 24., 10., 0.5);
  const auto found     = run_solid_in_time(in_time).rows.back();
  const auto &cylinder = without.cylinder;
  EXPECT_LT(expected.across[tilt_column], 0.8 * cylinder.tilt);
  EXPECT_GT(std::abs(expected.across[skew_column] - cylinder.skew), 1e-4);
  EXPECT_NEAR(found[Column::P], expected[Column::P], 1e-3 * expected[Column::P]);
  EXPECT_NEAR(found.across[tilt_column], expected.across[tilt_column], 1e-3 * cylinder.tilt);
  EXPECT_NEAR(found.across[skew_column], expected.across[skew_column], 1e-3 * cylinder.skew);
}

TEST(SolidShaftInTime, TheLedgerClosesOverAReversal)
{
  Scene scene = with_fixed_step(yielding(AnalysisType::transient), 5e-5);
  scene.drive = Drive(DriveProfile::triangle, 22., 24., 112., 1.);
  double work = 0., open = 0.;
  for (const auto &row : run_solid_in_time(scene).rows)
  {
    work = std::max(work, std::abs(row[Column::drive_work]));
    open = std::max(open, std::abs(row[Column::energy_residual]));
  }
  EXPECT_LT(open, 1e-7 * work);
}

// Before a lever inclined by theta a skew presses where the axis comes forward, by sin(theta) of it, and there P sin(theta) and
// friction mu P cos(theta) push it, in a slide back one against the other: a true axis stays so where the shaft is stiffer than
//   S sin(theta) (mu cos(theta) - sin(theta)),
// S the moment over a slope across the face, which a small tilt tells. Lever and layer yield in both alike but for friction.
TEST(SolidShaftInTime, FrictionTurnsASkewThatAShaftHoldsTooSoftly)
{
  Scene scene                   = yielding(AnalysisType::stability);
  scene.drive                   = Drive(DriveProfile::triangle, 0., 65., 112., 1.);
  scene.stability.position      = 65.;
  scene.cylinder.tilt           = 1e-6;
  scene.cylinder.skew           = 0.;
  scene.cylinder.tilt_stiffness = scene.cylinder.skew_stiffness = std::nullopt;
  DynamicsMaker maker(false);
  const auto fixed = maker.make(scene);
  const auto slide = fixed.model().hold(held_drive(scene), ContactFriction::sliding);
  ASSERT_TRUE(slide);
  Row row;
  fixed.model().observe(slide->motion, row);
  const double s = std::sin(row[Column::theta]), c = std::cos(row[Column::theta]);
  const double limit = row.across[2] / (scene.cylinder.tilt * c) * s * (0.73 * c - s);
  EXPECT_GT(limit, 1e4);
  scene.cylinder.tilt = 0.;
  for (const double share : { 0.97, 1.03 })
  {
    scene.cylinder.skew_stiffness = share * limit;
    const auto held               = maker.make(scene).model().hold(held_drive(scene), ContactFriction::sliding);
    ASSERT_TRUE(held);
    EXPECT_EQ(held->uniqueness > 0., share > 1.) << limit << ' ' << held->uniqueness;
  }
}
