// SPDX-License-Identifier: GPL-3.0-only
#include "analysis/stability/stability.h"
#include "scene/closed_form.h"
#include "scene/scene.h"
#include "support/find_value.h"
#include "support/scene_parts.h"
#include "verification/run_scene.h"
#include "verification/run_transient.h"

#include <cstdio>
#include <gtest/gtest.h>
#include <limits>

using namespace sprag;

// Without inertia: the pivot frame on a spring, and a rotational spring that hardens.

namespace
{
  constexpr double mu = 0.73;

  /// Stiff enough that what is left of flexure is 1e-4, see RigidLimit.
  Scene nearly_rigid(const Scene &scene)
  {
    return with_face_size(with_stiffness(with_coulomb(scene, mu), 1000.), 1.);
  }

  struct Forces
  {
    double P, Q, u;
  };

  /// The rigid lever at x - u with k_f u = Q, its spring of any law: P = m(theta - theta_0) / (s + sigma mu e).
  Forces on_springs(const Scene &scene, const MomentLaw &law, const double k_f, const double x, const double direction)
  {
    const auto forces_at = [&](const double u)
    {
      const auto at     = kinematics(scene.geometry, x - u);
      const double turn = at.theta - kinematics(scene.geometry, 0.).theta;
      const double P    = law.moment(turn) / (at.s + direction * mu * scene.geometry.interface_offset);
      return Forces{ P, P * (std::sin(at.theta) + direction * mu * std::cos(at.theta)), u };
    };
    // dQ/dx is at most 1 N/mm, k_f some ten times that.
    Forces forces{};
    for (unsigned int i = 0; i < 60; ++i)
      forces = forces_at(forces.Q / k_f);
    return forces;
  }

  /// Largest deviation from the rigid lever on its springs over the stroke's peak, 10 mm after the reversal apart: so long the
  /// support takes to swing over, and the contact to slide fully.
  void expect_rigid_lever(const Scene &scene, const MomentLaw &law, const double k_f)
  {
    const auto rows = run_scene(scene);
    for (const double direction : { 1., -1. })
    {
      double peak_P = 0., peak_Q = 0., off_P = 0., off_Q = 0., off_u = 0.;
      for (const Row &row : rows)
        if (row[Column::x] > 0. && row[Column::v] * direction > 0. && (direction > 0. || row[Column::x] < 55.))
        {
          const auto forces = on_springs(scene, law, k_f, row[Column::x], direction);
          peak_P            = std::max(peak_P, forces.P);
          peak_Q            = std::max(peak_Q, std::abs(forces.Q));
          off_P             = std::max(off_P, std::abs(row[Column::P] - forces.P));
          off_Q             = std::max(off_Q, std::abs(row[Column::Q] - forces.Q));
          off_u             = std::max(off_u, std::abs(row[Column::support_displacement] - forces.u));
        }
      std::printf("direction %+.0f: P off by %.1e, Q by %.1e of their peaks, u by %.1e mm\n", direction, off_P / peak_P,
                  off_Q / peak_Q, off_u);
      EXPECT_LT(off_P, 2e-4 * peak_P);
      EXPECT_LT(off_Q, 1e-3 * peak_Q);
      EXPECT_LE(off_u, 1e-3 * peak_Q / k_f);
    }
  }
} // namespace

// Tolerances are those of RigidLimit. With k_f = 10 N/mm the support moves by 1 to 3 mm, which is 2 to 8 % of P.
TEST(SprungSupport, OfARigidLeverMeetsTheClosedForm)
{
  constexpr double k_f = 10.;
  for (const Scene &model : { model_a(), model_b() })
    expect_rigid_lever(on_sprung_support(nearly_rigid(model), k_f), MomentLaw(model.spring.stiffness), k_f);
}

// The spring hardens by 30 % over a turn of 0.03.
TEST(HardeningSpring, MovesPAsTheClosedFormSays)
{
  for (const Scene &model : { model_a(), model_b() })
  {
    Scene scene  = nearly_rigid(model);
    scene.spring = with_cubic_hardening(scene.spring.stiffness, 330.);
    expect_rigid_lever(scene, scene.spring.behaviour.law, std::numeric_limits<double>::infinity());
  }
}

// A preload of k 0.01 is 740 N mm at x = 0, a third of the moment at the end of the stroke.
TEST(PreloadedSpring, MovesPAsTheClosedFormSays)
{
  Scene scene             = nearly_rigid(model_a());
  scene.spring.rest_angle = -0.01;
  expect_rigid_lever(scene, MomentLaw(scene.spring.stiffness).at_rest_at(-0.01), std::numeric_limits<double>::infinity());
}

// One stroke, at the end of which the support holds 2 to 5 % of the work: the ledger closes to a tenth of that with it.
TEST(SprungSupport, ItsEnergyClosesTheLedger)
{
  const Drive forward(DriveProfile::triangle, 0., 65., 112., 0.5);
  for (const Scene &model : { model_a(), model_b() })
  {
    const Scene scene  = with_step(on_sprung_support(with_drive(with_coulomb(model, mu), forward), 10.), 0.25);
    const auto rows    = run_scene(scene);
    const auto summary = make_summary(scene, rows);
    const double share = find_value(summary, "energy_residual") / find_value(summary, "loop_area");
    const double held  = rows.back()[Column::support_energy] / find_value(summary, "loop_area");
    std::printf("residual %.1e of the work, the support holds %.1e\n", share, held);
    EXPECT_GT(held, 0.015);
    EXPECT_LT(std::abs(share), 0.1 * held);
  }
}
