// SPDX-License-Identifier: GPL-3.0-only
#include "analysis/accuracy/slide_samples.h"
#include "scene/closed_form.h"
#include "scene/scene.h"
#include "support/find_value.h"
#include "verification/run_scene.h"

#include <gtest/gtest.h>

using namespace sprag;

namespace
{
  constexpr double mu = 0.73;

  std::vector<Scene> models()
  {
    return { with_coulomb(model_a(), mu), with_coulomb(model_b(), mu) };
  }

  /// Returns what the ledger of a loop between 50 and 60 mm leaves open, over the work of friction.
  double residual(const Scene &scene, const double step)
  {
    const Scene loop   = with_step(with_drive(scene, Drive(DriveProfile::triangle, 50., 60., 112., 1.)), step);
    const auto summary = make_summary(loop, run_scene(loop));
    return find_value(summary, "energy_residual") / find_value(summary, "friction_work");
  }
} // namespace

// Friction works at the speed at which points slide where a step ends, so that long steps close the ledger as short ones do. What
// is left, 1e-4, is the passage through stick behind the reversal, whose steps are chosen by the analysis.
TEST(EnergyLedger, ClosesAtEveryStep)
{
  for (const Scene &scene : models())
    for (const double step : { 2., 0.5 })
      EXPECT_LT(std::abs(residual(scene, step)), 2e-4);
}

// Facets of both faces carry the friction; its speed is that of their slip, whose slope is a difference between neighbours.
TEST(EnergyLedger, ClosesWithAnElasticCylinder)
{
  Scene scene         = models().front();
  scene.cylinder.type = CylinderType::solid;
  EXPECT_LT(std::abs(residual(scene, 1.)), 5e-4);
}

// Multipliers are means over faces. Friction of a point that slips keeps its own: the difference would pass for slip, the more in
// short steps, and mu would be that of another speed.
TEST(AugmentedLagrangian, FrictionOfShortStepsIsThatOfTheSpeed)
{
  const Scene scene = with_face_size(with_augmented_lagrangian(model_a()), 2.);
  const Drive drive(DriveProfile::triangle, 0., 65., 112., 0.5);
  std::vector<Row> samples;
  for (unsigned int i = 0; i < 40; ++i)
    samples.emplace_back(drive.at((60. + 1e-4 * i) / 112.));
  const MadeMesh triangulation(scene);
  StaticLever<2> model(triangulation, scene);
  const auto rows   = solve_at_samples(model, samples, 0., { 1., 1e-6, scene.contact });
  const Row &last   = rows.back();
  const double mu_v = friction_coefficient(step_friction(scene.friction, 112.), std::abs(last[Column::v_rel])).coefficient;
  EXPECT_NEAR(last[Column::friction_resultant] / (mu_v * last[Column::normal_resultant]), 1., 1e-3);
}

// Augmentation leaves a penetration, which turns the lever by as much over the distance of the contact.
TEST(PenetrationTolerance, IsHowFarAugmentationLeavesTheLever)
{
  Scene scene           = with_face_size(with_augmented_lagrangian(with_coulomb(model_a(), mu)), 2.);
  scene.drive           = Drive(DriveProfile::triangle, 0., 65., 112., 0.5);
  scene.analysis.step   = 20.;
  scene.contact.penalty = 50.;
  const auto theta_with = [&](const double tolerance)
  {
    scene.contact.penetration_tolerance = tolerance;
    return run_scene(scene).back()[Column::theta];
  };
  const double s = kinematics(scene.geometry, 65.).s;
  EXPECT_LT(std::abs(theta_with(1e-6) - theta_with(1e-9)), 1e-6 / s);
}
