// SPDX-License-Identifier: GPL-3.0-only
#include "model/contact/circle.h"
#include "scene/closed_form.h"
#include "scene/scene.h"
#include "support/made_mesh.h"
#include "support/turning_axis.h"
#include "verification/face_forces.h"
#include "verification/solid_run.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

// A rigid cylinder whose axis yields on its shaft, without inertia.

using namespace sprag;

namespace
{
  using Vector = Resultant::Vector;

  constexpr std::size_t tilt_column = 5, skew_column = 6; ///< among those across

  Scene on_shaft(Scene scene, const double tilt_stiffness, const double skew_stiffness)
  {
    scene.cylinder.tilt_stiffness = tilt_stiffness;
    scene.cylinder.skew_stiffness = skew_stiffness;
    return scene;
  }

  /// Out of true both ways, on a shaft that yields by a good part of that.
  Scene yielding()
  {
    return on_shaft(tilted(solid_model_a(0.3), 4e-4, 2e-3), 4e5, 1e5);
  }

  /// Moments of the forces on the face about the cylinder's middle that turn its axis: those that work on tilt and on skew.
  std::array<double, 2> moments_on_axis(const Scene &scene, const SolidBody &body, const State &state, const Row &row)
  {
    const auto on_lever = forces_on(body, state)[1];
    const auto centre   = cylinder_centre(scene.geometry, row[Column::x], row[Column::theta]);
    const auto moment   = on_lever.moment - cross_product_3d(Vector({ centre.xi, centre.eta, 0. }), on_lever.force);
    const double c = std::cos(row[Column::theta]), s = std::sin(row[Column::theta]);
    // The lever's axes xi, eta, zeta are left-handed: moments in them have the other sign in the world.
    const Vector on_cylinder({ -moment[0] * c + moment[1] * s, moment[0] * s + moment[1] * c, moment[2] });
    const auto [tilts, skews] = turns_by_slopes(row.across[tilt_column], row.across[skew_column]);
    return { { tilts * on_cylinder, skews * on_cylinder } };
  }
} // namespace

/// Enforcement of the contact.
class SolidShaft : public testing::TestWithParam<Enforcement>
{
};

INSTANTIATE_TEST_SUITE_P(By, SolidShaft, testing::Values(Enforcement::penalty, Enforcement::augmented_lagrangian));

TEST_P(SolidShaft, CarriesTheMomentOfTheFaceAboutItsMiddle)
{
  Scene scene               = yielding();
  scene.contact.enforcement = GetParam();
  const MadeMesh plane(scene);
  const SolidBody body(scene, plane);
  StaticLever<3> lever(body, scene);
  std::array<double, 2> off{}, peak{};
  run_quasi_static(lever, scene.drive, { scene.analysis.step, scene.analysis.minimum_step, scene.contact },
                   [&](const State &state, const Row &row, const Evaluation &)
                   {
                     const auto moments                  = moments_on_axis(scene, body, state, row);
                     const std::array<double, 2> carried = {
                       { *scene.cylinder.tilt_stiffness * (row.across[tilt_column] - scene.cylinder.tilt),
                         *scene.cylinder.skew_stiffness * (row.across[skew_column] - scene.cylinder.skew) }
                     };
                     for (unsigned int i = 0; i < 2; ++i)
                     {
                       off[i]  = std::max(off[i], std::abs(moments[i] - carried[i]));
                       peak[i] = std::max(peak[i], std::abs(moments[i]));
                     }
                   });
  for (unsigned int i = 0; i < 2; ++i)
  {
    EXPECT_GT(peak[i], 10.) << i; // [N mm]
    EXPECT_LT(off[i], 1e-7 * peak[i]) << i;
  }
}

// The work of the drive is stored in springs, lever and shaft, or rubbed away. The works are sums over steps, whose error falls
// with them; the shaft stores more than that.
TEST(SolidShaft, StoresTheWorkThatItTakes)
{
  Scene scene         = on_shaft(tilted(solid_model_a(0.3), 0.02), 4e3, 4e3);
  scene.drive         = Drive(DriveProfile::triangle, 0., 20., 112., 0.5);
  scene.analysis.step = 0.25;
  const SolidRun run(scene);
  const auto stored   = [](const Row &row) { return row[Column::spring_energy] + row[Column::elastic_energy]; };
  const Row &last     = run.rows.back();
  double shaft_energy = 0.;
  for (const std::size_t column : { tilt_column, skew_column })
  {
    const double yielded = last.across[column] - (column == tilt_column ? scene.cylinder.tilt : scene.cylinder.skew);
    shaft_energy += 0.5 * *scene.cylinder.tilt_stiffness * yielded * yielded;
  }
  const double work = last[Column::drive_work];
  const double open = work - last[Column::friction_work] - stored(last) + stored(run.rows.front());
  EXPECT_GT(shaft_energy, 0.01 * work);
  EXPECT_NEAR(open, 0., 1e-3 * work);
}
