// SPDX-License-Identifier: GPL-3.0-only
#include "analysis/statics/quasi_static.h"
#include "fe/mesh/lever_mesh.h"
#include "fe/statics/static_lever.h"
#include "mpi_environment.h"
#include "scene/scene.h"
#include "scenes.h"
#include "support/compared_rows.h"
#include "support/made_mesh.h"
#include "support/scene_parts.h"
#include "verification/pressed_block.h"

#include <cmath>
#include <gtest/gtest.h>

using namespace sprag;

namespace
{
  Scene coarse(const Enforcement enforcement, const double face_size)
  {
    Scene scene               = model_a();
    scene.mesh.face_size      = face_size;
    scene.contact.enforcement = enforcement;
    return scene;
  }

  /// Forward to 65 mm and back to the beginning at 112 mm/s, with small steps through stick.
  std::vector<DrivePoint> there_and_back()
  {
    std::vector<DrivePoint> drive;
    for (const double x : { 0., 10., 30., 50., 65. })
      drive.push_back({ x / 112., x, 112. });
    for (const double back : { 1e-3, 6e-3, 0.02, 0.04, 0.1, 1., 10., 30., 50., 65. })
      drive.push_back({ (65. + back) / 112., 65. - back, -112. });
    return drive;
  }

  /// Through the very positions of `drive`, with augmentations down to 1e-6 mm where the model has multipliers.
  std::vector<Row> follow(Scene scene, const Solution solution, const std::vector<DrivePoint> &drive)
  {
    scene.analysis.solution = solution;
    const MadeMesh mesh(scene);
    StaticLever<2> model(mesh, scene);
    const bool augmented = scene.contact.enforcement == Enforcement::augmented_lagrangian;
    std::vector<Row> rows;
    State accepted = model.initial_state(drive.front());
    for (const auto &point : drive)
    {
      Step step   = model.begin_step(accepted, point);
      auto solved = equilibrate(model, step);
      EXPECT_TRUE(solved.converged) << "x " << point.x;
      const double tolerance = scene.contact.penetration_tolerance;
      for (unsigned int i = 0; augmented && model.penetration(solved.found) > tolerance && i < 20; ++i)
      {
        model.augment(solved.found, step.trial);
        solved = solve_equilibrium(model, step, false);
        EXPECT_TRUE(solved.converged) << "x " << point.x;
      }
      Row row;
      model.observe(step.trial, solved.found, row);
      rows.push_back(row);
      model.store_history(solved.found, step.trial);
      accepted = step.trial;
    }
    return rows;
  }

  // Both solve the same equations to corrections below 1e-7 of the penetration where convergence is quadratic: what is left is
  // round-off.
  void expect_same_answers(const Scene &scene)
  {
    const auto fast = follow(scene, Solution::automatic, there_and_back());
    const auto slow = follow(scene, Solution::general, there_and_back());
    for (const auto column :
         { Column::P, Column::Q, Column::theta, Column::elastic_energy, Column::spring_energy, Column::Q_support })
    {
      EXPECT_GT(largest(fast, column), 0.);
      EXPECT_LE(difference(fast, slow, column), 1e-8) << column_info(column).name;
    }
  }
} // namespace

TEST(FactoriseOnce, MeetsTheGeneralPathThroughTheReversal)
{
  expect_same_answers(coarse(Enforcement::penalty, 2.));
}

TEST(FactoriseOnce, MeetsTheGeneralPathOnASprungSupportAndAHardeningSpring)
{
  Scene scene             = coarse(Enforcement::penalty, 2.);
  scene.support.type      = SupportType::sprung;
  scene.support.stiffness = 50.;
  scene.spring            = with_cubic_hardening(scene.spring.stiffness, 300.);
  expect_same_answers(scene);
}

TEST(FactoriseOnce, MeetsTheGeneralPathOnAnElasticCylinder)
{
  expect_same_answers(on_solid_cylinder(coarse(Enforcement::penalty, 2.), 7e4));
}

TEST(FactoriseOnce, MeetsTheGeneralPathWithMultipliersSlow)
{
  expect_same_answers(coarse(Enforcement::augmented_lagrangian, 1.));
}
