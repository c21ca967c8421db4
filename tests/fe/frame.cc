// SPDX-License-Identifier: GPL-3.0-only
#include "fe/dynamics/condensed_basis.h"
#include "fe/mesh/lever_mesh.h"
#include "fe/statics/lever_properties.h"
#include "mpi_environment.h"
#include "scene/scene.h"
#include "scenes.h"
#include "support/made_mesh.h"

#include <gtest/gtest.h>

using namespace sprag;

namespace
{
  Scene frame(const unsigned int pockets, const double web)
  {
    Scene scene          = model_a();
    scene.mesh.face_size = 2.;
    scene.lever.outline  = LeverOutline::frame;
    scene.lever.depth    = 24.;
    scene.frame.pockets  = pockets;
    scene.frame.web      = web;
    return scene;
  }

  struct Vibration
  {
    std::vector<double> omega_squared; ///< the first is the lever on its spring
    double mass    = 0.;
    double inertia = 0.;
  };

  Vibration vibration(const Scene &scene)
  {
    const MadeMesh triangulation(scene);
    const ElasticBody<2> body(triangulation, lever_properties(scene).body);
    LeverInertia inertia;
    inertia.densities = { { material_id::lever, scene.lever.density },
                          { material_id::web, scene.lever.density },
                          { material_id::layer, scene.layer.density } };
    inertia.source    = InertiaSource::as_built;
    const auto modes  = lever_modes(body, make_response(body), inertia, scene.spring.stiffness, 5);
    return { modes.stiffness, modes.total_mass, modes.moment_of_inertia };
  }
} // namespace

TEST(Frame, WithAWebOfFullWidthVibratesAsTheSolidOne)
{
  const auto webbed = vibration(frame(3, 40.));
  const auto solid  = vibration(frame(0, 0.));
  // The same lever on two meshes.
  EXPECT_NEAR(webbed.mass, solid.mass, 1e-9 * solid.mass);
  EXPECT_NEAR(webbed.inertia, solid.inertia, 1e-9 * solid.inertia);
  for (std::size_t i = 0; i < 5; ++i)
    EXPECT_NEAR(webbed.omega_squared[i], solid.omega_squared[i], 1e-3 * solid.omega_squared[i]) << i;
}

TEST(Frame, PocketsTakeMassAndStiffness)
{
  const auto scene  = frame(3, 10.);
  const auto webbed = vibration(scene);
  const auto solid  = vibration(frame(0, 0.));
  // Three pockets of 52 mm, of the mean depth at their middles less the flanges; 30 of 40 mm of the width are gone.
  double hollow = 0.;
  for (const double xi : { 62., 120., 178. })
    hollow += 52. * (24. - 12. * (xi - 30.) / 180. - 8.);
  EXPECT_NEAR(solid.mass - webbed.mass, 2.7e-9 * 30. * hollow, 1e-9 * solid.mass);
  // Stiffness is no mode's: the lever's first bends less easily than its mass alone would tell.
  const double lightened = solid.mass / webbed.mass;
  EXPECT_GT(webbed.omega_squared[1], solid.omega_squared[1]);
  EXPECT_LT(webbed.omega_squared[1], lightened * solid.omega_squared[1]);
}
