// SPDX-License-Identifier: GPL-3.0-only
#include "scene/scene.h"
#include "support/compared_rows.h"
#include "verification/meshed_in_time.h"

#include <gtest/gtest.h>

using namespace sprag;

namespace
{
  /// Model A around its reversal on an elastic cylinder, short and coarse.
  Scene reversal(const ModelType model)
  {
    Scene scene              = with_fixed_step(in_time(model_a(), model), 5e-5);
    scene.drive              = Drive(DriveProfile::triangle, 64.75, 65., 112., 1., 2e-3);
    scene.mesh.face_size     = 1.;
    scene.cylinder.type      = CylinderType::solid;
    scene.cylinder.face_size = 0.5;
    return scene;
  }
} // namespace

// Third-order terms of the rows, as with a rigid cylinder; the finite elements' own solver leaves 2e-7 there too.
TEST(ElasticCylinderInTime, LedgerClosesAndCondensedAgreesWithFiniteElements)
{
  const auto condensed = run_meshed_in_time(reversal(ModelType::condensed)).rows;
  const auto finite    = run_meshed_in_time(reversal(ModelType::finite_element)).rows;
  EXPECT_LT(largest(condensed, Column::energy_residual), 1e-7 * largest(condensed, Column::drive_work));
  EXPECT_LT(largest(finite, Column::energy_residual), 1e-6 * largest(finite, Column::drive_work));
  EXPECT_GT(finite.back()[Column::friction_work], 2.);
  // The tolerance is the motion of modes beyond the 20 kept, as with a rigid cylinder.
  EXPECT_LT(difference(finite, condensed, Column::P), 5e-3);
  EXPECT_LT(difference(finite, condensed, Column::Q), 5e-3 * largest(finite, Column::P) / largest(finite, Column::Q));
}
