// SPDX-License-Identifier: GPL-3.0-only
#include "scene/scene.h"
#include "support/find_value.h"
#include "verification/run_scene.h"

#include <gtest/gtest.h>

using namespace sprag;

// Lever and friction layer 1000 times stiffer are nearly the rigid lever of the closed form: P and Q of both strokes meet it.

namespace
{
  struct Case
  {
    const char *name;
    Scene scene;
  };

  std::vector<Case> cases(const double face_size)
  {
    const auto stiff = [&](const Scene &scene) { return with_face_size(with_stiffness(scene, 1000.), face_size); };
    return { { "A, mu 0.73", stiff(with_coulomb(model_a(), 0.73)) },
             { "A, mu(v)", stiff(model_a()) },
             { "B, mu 0.73", stiff(with_coulomb(model_b(), 0.73)) },
             { "B, mu(v)", stiff(model_b()) } };
  }

  struct Deviation
  {
    double P_forward, Q_forward, P_backward, Q_backward;
  };

  /// Relative to the stroke's peak, the first 2 mm after the reversal apart.
  Deviation compute_deviation(const Scene &scene)
  {
    const auto summary = make_summary(scene, run_scene(scene));
    return { find_value(summary, "deviation_P_forward"), find_value(summary, "deviation_Q_forward"),
             find_value(summary, "deviation_P_backward"), find_value(summary, "deviation_Q_backward") };
  }

  void expect_closed_form(const double face_size, const double tolerance_P, const double tolerance_Q)
  {
    for (const auto &[name, scene] : cases(face_size))
    {
      SCOPED_TRACE(name);
      const auto off = compute_deviation(scene);
      EXPECT_LT(off.P_forward, tolerance_P);
      EXPECT_LT(off.P_backward, tolerance_P);
      EXPECT_LT(off.Q_forward, tolerance_Q);
      EXPECT_LT(off.Q_backward, tolerance_Q);
    }
  }
} // namespace

// The remaining difference is the mechanics of a lever that yields a thousandth as much. P: 0.4 to 0.7 % with aluminium and
// cork, so 1e-5. Up to half the distance of 0.02 mm between the integration points over s adds 1e-4. Q: in a thin layer a
// contact of half-width a leans by mu a / 2.6 at most under its own shear. With a = 0.05 mm that is 6e-4 rad for model B where
// the mesh resolves it, times the force across x, 2 Q. A coarse mesh leans less. Contact points at nodes would leave half a
// face size in s, 4e-3.
TEST(RigidLimit, MeetsTheClosedFormAtACoarseMesh)
{
  expect_closed_form(1., 2e-4, 1e-3);
}

TEST(SlowRigidLimit, MeetsTheClosedFormWithin1PerMil)
{
  expect_closed_form(0.125, 1e-3, 1e-3);
}
