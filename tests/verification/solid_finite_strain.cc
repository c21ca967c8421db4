// SPDX-License-Identifier: GPL-3.0-only
#include "scene/scene.h"
#include "verification/solid_run.h"

using namespace sprag;

namespace
{
  /// With a layer so soft that linear theory is off by 1 %.
  Scene at_finite_strain(const double poisson_ratio)
  {
    Scene scene               = solid_model_a(poisson_ratio);
    scene.analysis.plane      = PlaneState::strain;
    scene.lever.material      = MaterialModel::neo_hookean;
    scene.layer.young_modulus = 0.5;
    scene.drive               = Drive(DriveProfile::triangle, 0., 10., 112., 1.);
    return scene;
  }

  double work(const Row &row)
  {
    return row[Column::drive_work] - row[Column::friction_work];
  }
} // namespace

// Without contraction planes along the lever do not feel each other. Steps end where nothing moves by 1e-7 of the penetration,
// which sums up to 1e-6 along the way. Linear theory is off by far more than the bound.
TEST(SolidFiniteStrain, WithoutContractionItIsPlaneStrain)
{
  Scene scene                = at_finite_strain(0.);
  scene.mesh.elements_across = 2;
  scene.drive                = Drive(DriveProfile::triangle, 0., 10., 112., 0.5);
  scene.analysis.step        = 2.5;
  Scene linear               = scene;
  linear.lever.material      = MaterialModel::linear;
  const SolidRun solid(scene), small(linear);
  const auto rows = run_scene(in_plane(scene));
  for (const Column column : { Column::P, Column::Q, Column::theta, Column::penetration, Column::elastic_energy })
    EXPECT_LT(difference(rows, solid.rows, column), 5e-6) << column_info(column).name;
  EXPECT_GT(difference(small.rows, solid.rows, Column::indentation), 5e-3);
}

// With contraction, which couples all directions, under an axis out of true: what goes in is stored or rubbed away, as far as
// steps of a millimetre sum it.
TEST(SolidFiniteStrain, WorkIsStoredOrRubbedAwaySlow)
{
  Scene scene                = tilted(at_finite_strain(0.3), 2e-4);
  scene.mesh.elements_across = 2;
  const SolidRun solid(scene);
  double residual = 0., largest_work = 0.;
  for (const auto &row : solid.rows)
  {
    residual     = std::max(residual, std::abs(work(row) - row[Column::elastic_energy] - row[Column::spring_energy]));
    largest_work = std::max(largest_work, row[Column::drive_work]);
  }
  EXPECT_LT(residual, 2e-3 * largest_work);
}
