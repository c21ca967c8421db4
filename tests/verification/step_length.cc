// SPDX-License-Identifier: GPL-3.0-only
#include "scene/scene.h"
#include "support/made_mesh.h"
#include "verification/run_scene.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

using namespace sprag;

namespace
{
  double largest_Q(const Scene &scene, const double step, const bool at_the_end)
  {
    const MadeMesh triangulation(scene);
    auto properties = lever_properties(scene);
    if (!at_the_end)
      properties.is_damper = false;
    StaticLever<2> model(triangulation, properties);
    double result = 0.;
    run_quasi_static(model, scene.drive, { step, scene.analysis.minimum_step, scene.contact },
                     [&](const State &, const Row &row, const Evaluation &) { result = std::max(result, row[Column::Q]); });
    return result;
  }
} // namespace

// Slid to 26 mm in steps that are longer and far shorter than the contact is wide, some 1.5 mm. The mean speed of a long step
// misses the strain of the face, some 1 % at mu'(v) v/mu = 0.36.
TEST(StepLength, DoesNotMatterToFrictionThatDependsOnSpeed)
{
  Scene scene            = with_drive(with_face_size(model_a(), 1.), Drive(DriveProfile::triangle, 0., 26., 112., 0.5));
  const double reference = largest_Q(scene, 0.25, true);
  EXPECT_NEAR(largest_Q(scene, 13., true), reference, 1e-4 * reference);
  EXPECT_NEAR(largest_Q(scene, 1., true), reference, 1e-4 * reference);
  EXPECT_GT(std::abs(largest_Q(scene, 13., false) - reference), 5e-4 * reference);
}
