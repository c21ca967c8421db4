// SPDX-License-Identifier: GPL-3.0-only
#include "scene/scene.h"
#include "verification/meshed_in_time.h"

#include <cmath>
#include <gtest/gtest.h>

using namespace sprag;

namespace
{
  /// Model A around its reversal, short and coarse.
  Scene reversal(const ModelType model, const CylinderType type, const double start = 64.5)
  {
    Scene scene              = with_fixed_step(in_time(model_a(), model), 5e-5);
    scene.drive              = Drive(DriveProfile::triangle, start, 65., 112., 1., 2e-3);
    scene.mesh.face_size     = 1.;
    scene.cylinder.type      = type;
    scene.cylinder.face_size = 0.5;
    return scene;
  }

  double largest(const TransientRun &run, const Column column)
  {
    double result = 0.;
    for (const auto &row : run.rows)
      result = std::max(result, std::abs(row[column]));
    return result;
  }

  double largest_difference(const TransientRun &a, const TransientRun &b, const Column column)
  {
    EXPECT_EQ(a.rows.size(), b.rows.size());
    double result = 0.;
    for (std::size_t i = 0; i < std::min(a.rows.size(), b.rows.size()); ++i)
      result = std::max(result, std::abs(a.rows[i][column] - b.rows[i][column]));
    return result;
  }
} // namespace

// Third-order terms of the rows, as with a rigid cylinder; the finite elements' own solver leaves 2e-7 there too.
TEST(ElasticCylinderInTime, LedgerClosesAndCondensedAgreesWithFiniteElements)
{
  const auto condensed = run_meshed_in_time(reversal(ModelType::condensed, CylinderType::solid, 64.75));
  const auto finite    = run_meshed_in_time(reversal(ModelType::finite_element, CylinderType::solid, 64.75));
  EXPECT_LT(largest(condensed, Column::energy_residual), 1e-7 * largest(condensed, Column::drive_work));
  EXPECT_LT(largest(finite, Column::energy_residual), 1e-6 * largest(finite, Column::drive_work));
  EXPECT_GT(finite.rows.back()[Column::friction_work], 2.);
  // The tolerance is the motion of modes beyond the 20 kept, as with a rigid cylinder.
  const double P = largest(finite, Column::P);
  EXPECT_LT(largest_difference(condensed, finite, Column::P), 5e-3 * P);
  EXPECT_LT(largest_difference(condensed, finite, Column::Q), 5e-3 * P);
}
