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

  double stored_energy(const Row &row)
  {
    return row[Column::kinetic_energy] + row[Column::spring_energy] + row[Column::elastic_energy] + row[Column::contact_energy];
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

// Without dissipation the ledger leaves open but the turn of the contact's rows within a step, see Ledger.
TEST(SolidShaftInTime, TheLedgerClosesWithTheWorkOfTheShaftSlow)
{
  Scene scene = with_spectral_radius(with_fixed_step(undamped(yielding(AnalysisType::transient)), 5e-5), 1.);
  scene       = with_coulomb(scene, 0.);
  scene.drive = Drive(DriveProfile::triangle, 20., 24., 112., 0.5);
  double peak = 0., open = 0., shaft = 0.;
  for (const auto &row : run_solid_in_time(scene).rows)
  {
    peak               = std::max(peak, stored_energy(row));
    open               = std::max(open, std::abs(row[Column::energy_residual]));
    const auto yielded = row.across[tilt_column] - scene.cylinder.tilt;
    shaft              = std::max(shaft, 0.5 * *scene.cylinder.tilt_stiffness * yielded * yielded);
  }
  EXPECT_GT(shaft, 1e-4 * peak);
  EXPECT_LT(open, 1e-8 * peak);
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

// See Growth.
TEST(SolidShaftInTime, AVibrationGrowsAsItsEigenvalueSaysSlow)
{
  Scene scene                   = yielding(AnalysisType::sprag_slip);
  scene.drive                   = Drive(DriveProfile::triangle, 0., 65., 112., 1.);
  scene.contact.penalty         = std::nullopt;
  scene.lever.depth             = 6.;
  scene.cylinder.tilt           = 1e-4;
  scene.cylinder.skew           = 0.;
  scene.cylinder.skew_stiffness = 1e6;
  scene.stability.position      = 65.;
  const JudgedSlide checked(scene);
  ASSERT_EQ(checked.stability.kind, SlideKind::flutter);
  HeldRun run(checked.dynamics.model(), checked.step());
  const auto growth = measure_growth(checked.dynamics.model(), checked.stability, scene.sprag_slip, run, [](const Row &) {});
  EXPECT_TRUE(growth.reached);
  EXPECT_TRUE(growth.slid);
  EXPECT_NEAR(growth.growth_difference(), 0., 0.003);
  EXPECT_NEAR(growth.frequency_difference(), 0., 0.0005);
}

namespace
{
  /// Modes without friction of a slide before a true cylinder, in contact or not.
  std::vector<Eigenmode> modes_on(const std::optional<double> &stiffness, const bool in_contact = true)
  {
    Scene scene         = yielding(AnalysisType::stability);
    scene.cylinder.tilt = scene.cylinder.skew = 0.;
    scene.cylinder.tilt_stiffness = scene.cylinder.skew_stiffness = stiffness;
    DynamicsMaker maker(false);
    const auto dynamics = maker.make(scene);
    const auto slide    = dynamics.model().hold(held_drive(scene), ContactFriction::none);
    EXPECT_TRUE(slide);
    auto modes = dynamics.model().vibrations(*slide, in_contact, 10);
    find_across_shares({ &dynamics.solid->modes }, modes);
    return modes;
  }

  /// Frequency of the first mode most of which is of a kind [1/s].
  double find_first(const std::vector<Eigenmode> &modes, double Eigenmode::AcrossShares::*const share)
  {
    const auto found = std::find_if(modes.begin(), modes.end(), [share](const auto &mode) { return mode.across.*share > 0.5; });
    EXPECT_NE(found, modes.end());
    return found == modes.end() ? 0. : found->mode.eigenvalue.imag();
  }
} // namespace

// Motion as in a plane does not turn the axis. A lever that twists does: before an axis that aligns itself it twists as if out
// of contact, before a stiff one as before a fixed one.
TEST(SolidShaftInTime, OfATrueAxisTwistingModesAloneKnowSlow)
{
  using Shares     = Eigenmode::AcrossShares;
  const auto fixed = modes_on({}), aligning = modes_on(100.), stiff = modes_on(1e12);
  const double planar = find_first(fixed, &Shares::plane), twisting = find_first(fixed, &Shares::twisting);
  const double open = find_first(modes_on({}, false), &Shares::twisting);
  EXPECT_NEAR(find_first(aligning, &Shares::plane), planar, 1e-7 * planar);
  EXPECT_GT(twisting, 1.003 * open);
  EXPECT_NEAR(find_first(aligning, &Shares::twisting), open, 3e-4 * open);
  EXPECT_NEAR(find_first(stiff, &Shares::twisting), twisting, 1e-6 * twisting);
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
