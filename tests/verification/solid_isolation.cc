// SPDX-License-Identifier: GPL-3.0-only
#include "analysis/isolation/lever_table.h"
#include "analysis/transient/transient.h"
#include "levers/dynamics.h"
#include "scene/scene.h"
#include "scenes.h"
#include "support/isolated.h"
#include "verification/run_scene.h"
#include "verification/run_transient.h"

#include <gtest/gtest.h>

// A table on levers in three dimensions.

using namespace sprag;

namespace
{
  struct TableOnLevers
  {
    std::vector<double> z; ///< at each row
    IsolationFindings found;
  };

  /// Let go 30 mm from rest, and on through the middle, so that both levers come into contact. Levers of model A without
  /// contraction, where plane stress is exact.
  Scene let_go(const unsigned int dimension)
  {
    Scene scene               = with_face_size(model_a(), 4.);
    scene.analysis.type       = AnalysisType::isolation;
    scene.analysis.model      = ModelType::condensed;
    scene.analysis.dimension  = dimension;
    scene.lever.poisson_ratio = scene.layer.poisson_ratio = 0.;
    scene.mesh.elements_across                            = 2;
    scene.condensed.modes                                 = 12;
    scene.isolation                                       = isolated(DamperType::lever).isolation;
    scene.isolation.initial_displacement                  = 30.;
    scene.isolation.duration                              = 0.7;
    scene.isolation.output_step                           = 5e-3;
    return with_fixed_step(scene, 2e-4);
  }

  TableOnLevers run(const Scene &scene)
  {
    DynamicsMaker maker(false);
    const auto outward = maker.make(scene), inward = maker.make(scene);
    LeverTable table(scene, outward.model(), inward.model(), transient_settings(scene, {}));
    TableOnLevers result;
    run_isolation(scene, table, result.found,
                  [&](const IsolatedTable &moving_table, const bool is_before)
                  {
                    if (!is_before)
                      result.z.push_back(moving_table.state().z);
                  });
    return result;
  }
} // namespace

TEST(SolidIsolation, ATableOnLeversMovesAsInThePlane)
{
  const auto plane = run(let_go(2)), solid = run(let_go(3));
  EXPECT_EQ(plane.found.turns, 1u);
  EXPECT_EQ(solid.found.turns, plane.found.turns);
  ASSERT_EQ(solid.z.size(), plane.z.size());
  EXPECT_LT(plane.z.back(), -5.);
  for (std::size_t i = 0; i < plane.z.size(); ++i)
    EXPECT_NEAR(solid.z[i], plane.z[i], 2e-6 * 30.) << i;
  // Forces of the plane's run differ by up to 1e-6 of their peak between kernels of OpenBLAS, and their work by several
  // times that.
  EXPECT_NEAR(solid.found.dissipated, plane.found.dissipated, 1e-5 * plane.found.dissipated);
  EXPECT_LT(solid.found.energy_residual, 1e-7);
}
