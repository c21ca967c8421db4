// SPDX-License-Identifier: GPL-3.0-only
#include "fe/dynamics/solid_dynamics.h"

#include "run_scene.h"
#include "scene/held_slide.h"
#include "scene/scene.h"
#include "scenes.h"
#include "verification/held_slides.h"

#include <algorithm>
#include <array>
#include <gtest/gtest.h>

using namespace sprag;

namespace
{
  /// A slide of model A held at x = 30 on a coarse mesh without contraction, where plane stress is exact.
  Scene held_model_a(const unsigned int dimension, const AnalysisType type = AnalysisType::stability)
  {
    Scene scene               = with_face_size(model_a(), 4.);
    scene.analysis.type       = type;
    scene.analysis.model      = ModelType::condensed;
    scene.analysis.dimension  = dimension;
    scene.lever.poisson_ratio = scene.layer.poisson_ratio = 0.;
    scene.mesh.elements_across                            = 2;
    scene.stability.position                              = 30.;
    scene.stability.critical                              = "none";
    scene.condensed.modes                                 = 12;
    scene.friction.law                                    = CoulombFriction{ 0.73 }; // which nothing delays, see linearise()
    return scene;
  }

  std::vector<Eigenmode> compute_modes(const Scene &scene, const bool in_contact, const unsigned int number = 40)
  {
    DynamicsMaker maker(false);
    const auto dynamics = maker.make(scene);
    const auto slide    = dynamics.model().hold(held_drive(scene), ContactFriction::sliding);
    EXPECT_TRUE(slide);
    return slide ? dynamics.model().vibrations(*slide, in_contact, number) : std::vector<Eigenmode>();
  }

  /// The eigenvalue closest to one.
  std::complex<double> closest(const std::vector<Eigenmode> &modes, const std::complex<double> target)
  {
    const auto distance = [&](const Eigenmode &mode) { return std::abs(mode.mode.eigenvalue - target); };
    return std::min_element(modes.begin(), modes.end(), [&](const auto &a, const auto &b) { return distance(a) < distance(b); })
        ->mode.eigenvalue;
  }
} // namespace

// Modes of the plane are modes of the space: out of contact to the accuracy of the solver, in contact as far as the compliance of
// the face, which leaves out some 1e-5 on this mesh.
TEST(SolidInTime, ModesOfThePlaneAreAmongThem)
{
  for (const bool in_contact : { false, true })
  {
    const auto plane = compute_modes(held_model_a(2), in_contact), solid = compute_modes(held_model_a(3), in_contact);
    unsigned int compared = 0;
    for (const auto &mode : plane)
    {
      const auto value = mode.mode.eigenvalue;
      if (value.imag() == 0. || ++compared > 3)
        continue;
      EXPECT_LT(std::abs(closest(solid, value) - value), (in_contact ? 2e-5 : 1e-7) * std::abs(value)) << value;
    }
    EXPECT_GE(compared, 3u);
  }
}

// It is looked at beside the contact, where a thin lever bends by many times as much. Faces of both meshes are as wide as the
// contact, over which one takes parabolas and the other straight lines.
TEST(SolidInTime, IndentationOfAThinLeverIsThatOfThePlane)
{
  std::array<double, 2> found{};
  for (const unsigned int dimension : { 2u, 3u })
  {
    Scene scene       = with_face_size(held_model_a(dimension), 2.);
    scene.lever.depth = 5.;
    DynamicsMaker maker(false);
    const auto dynamics = maker.make(scene);
    const auto slide    = dynamics.model().hold(held_drive(scene), ContactFriction::sliding);
    ASSERT_TRUE(slide);
    found[dimension - 2] = slide->indentation;
  }
  EXPECT_GT(found[0], 0.);
  EXPECT_NEAR(found[1] / found[0], 1., 0.2);
}

// A perturbation grows at the rate of its eigenvalue, up to the error of steps and of a nonlinear contact, see Growth.
TEST(SolidInTime, AVibrationGrowsAsItsEigenvalueSays)
{
  Scene scene              = held_model_a(3);
  scene.lever.depth        = 6.;
  scene.cylinder.tilt      = 1e-4;
  scene.stability.position = 65.;
  scene.analysis.type      = AnalysisType::sprag_slip;
  expect_predicted_growth(JudgedSlide(scene));
}

// A drive that stands still slides the way that the sign of its speed says.
TEST(SolidInTime, SlidesBothWaysOneAfterTheOther)
{
  Scene solid    = held_model_a(3, AnalysisType::transient);
  solid.drive    = Drive(DriveProfile::triangle, 20., 64., 112., 1.);
  Scene plane    = solid;
  plane.analysis = held_model_a(2, AnalysisType::transient).analysis;
  DynamicsMaker maker(false);
  const auto plane_dynamics = maker.make(plane), solid_dynamics = maker.make(solid);
  for (const double x : { 30., 60., 45. })
    for (const double v : { 112., 0., -0., -112. })
    {
      const auto expected = plane_dynamics.model().sliding_forces({ 0., x, v, 0. }),
                 found    = solid_dynamics.model().sliding_forces({ 0., x, v, 0. });
      ASSERT_TRUE(!expected.empty() && !found.empty()) << x << " " << v;
      EXPECT_NEAR(found.front().P, expected.front().P, 1e-4 * expected.front().P) << x << " " << v;
    }
}

// Saint-Venant: f = sqrt(G J/(rho I_p))/(4 L), J = 0.2287 w d^3 of w = 2 d. The clamp hinders warping, and the layer has mass
// alone: 2 and 0.5 %.
TEST(SolidInTime, TheFirstTwistingModeIsThatOfABar)
{
  const Scene scene = held_model_a(3);
  DynamicsMaker maker(false);
  const auto dynamics = maker.make(scene);
  const auto slide    = dynamics.model().hold(held_drive(scene), ContactFriction::sliding);
  ASSERT_TRUE(slide);
  auto modes = dynamics.model().vibrations(*slide, false, 40);
  find_across_shares({ &dynamics.solid->modes }, modes);
  const auto twists = std::find_if(modes.begin(), modes.end(), [](const auto &mode) { return mode.across.twisting > 0.5; });
  ASSERT_NE(twists, modes.end());
  const auto &lever = scene.lever;
  ASSERT_EQ(lever.width, 2. * lever.depth);
  const double d = lever.depth, w = lever.width;
  const double shear   = lever.young_modulus / (2. * (1. + lever.poisson_ratio));
  const double density = lever.density * dynamics.meshed.density_factor;
  const double speed   = std::sqrt(shear * 0.2287 * w * d * d * d / (density * w * d * (w * w + d * d) / 12.));
  EXPECT_NEAR(twists->mode.eigenvalue.imag(), 2. * M_PI * speed / (4. * lever.length), 0.03 * twists->mode.eigenvalue.imag());
}
