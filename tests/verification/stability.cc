// SPDX-License-Identifier: GPL-3.0-only
#include "analysis/stability/stability.h"

#include "analysis/statics/contact_law.h"
#include "model/structure/modal_vibration.h"
#include "mpi_environment.h"
#include "scene/held_slide.h"
#include "scene/lever_inertia.h"
#include "scene/scene.h"
#include "scenes.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <gtest/gtest.h>

using namespace sprag;

namespace
{
  using Complex = std::complex<double>;

  constexpr ModelType meshed_models[] = { ModelType::condensed, ModelType::finite_element };

  Scene stability_scene(Scene scene, const ModelType model)
  {
    scene.analysis.type           = AnalysisType::stability;
    scene.analysis.model          = model;
    scene.lever.moment_of_inertia = scene.geometry.interface_offset == 0. ? 6.86 : 6.45;
    return scene;
  }

  Scene without_damping(Scene scene)
  {
    scene.stability.damping = false;
    return scene;
  }

  Scene with_depth(Scene scene, const double depth)
  {
    scene.lever.depth = depth;
    return scene;
  }

  /// Some thousand degrees of freedom, contact over a few elements.
  Scene coarse(Scene scene)
  {
    scene.mesh.face_size = 2.;
    return scene;
  }

  Scene at(Scene scene, const double x, const Direction direction)
  {
    scene.stability.position  = x;
    scene.stability.direction = direction;
    return scene;
  }

  /// The reduced model's contact law fitted to the meshed lever's indentations.
  Scene with_fitted_law(Scene scene)
  {
    const auto fit          = indent(scene).fit;
    scene.contact.stiffness = fit.stiffness;
    scene.contact.exponent  = fit.exponent;
    return scene;
  }

  double bisected(const std::function<bool(double)> &is_beyond, double low, double high)
  {
    for (unsigned int i = 0; i < 60; ++i)
    {
      const double middle              = 0.5 * (low + high);
      (is_beyond(middle) ? high : low) = middle;
    }
    return high;
  }
} // namespace

// Problem 11. M = 1, K = [[10, 2 - 4 mu], [2, 11]]: (10 - w)(11 - w) = 2 (2 - 4 mu) has a double root at mu = 4.25 / 8,
// w = 10.5. A growth of 1e-7 omega, which counts as such, is 6e-13 of mu beyond.
TEST(Flutter, OfTwoDegreesOfFreedomBeginsWhereRootsMeet)
{
  ModalData data;
  data.layout    = { 2, false };
  data.stiffness = { 10., 11. };
  data.damping.reinit(2, 2);
  data.shapes.reinit(3, 2);
  data.shapes(0, 0) = data.shapes(1, 1) = 1.;
  const auto worst                      = [&](const double mu)
  {
    LinearisedForces forces;
    forces.dofs = { 0, 1 };
    for (auto *const matrix :
         { &forces.pressure, &forces.friction, &forces.pressure_rate, &forces.friction_rate, &forces.inertia })
      matrix->reinit(2, 2);
    forces.friction(0, 1) = -(2. - 4. * mu);
    forces.friction(1, 0) = -2.;
    Complex result        = { -1e300, 0. };
    for (const auto &mode : modal_vibrations(data, forces))
      if (mode.eigenvalue.real() > result.real())
        result = mode.eigenvalue;
    return result;
  };
  const auto grows = [&](const double mu) { return worst(mu).real() > smallest_growth * std::abs(worst(mu)); };
  const double mu  = bisected(grows, 0., 1.);
  EXPECT_NEAR(mu, 0.53125, 1e-8);
  EXPECT_NEAR(worst(mu).imag(), std::sqrt(10.5), 1e-8);
  EXPECT_FALSE(grows(0.53124));
  // mu = 0.6: w = 10.5 +- sqrt(-0.55), lambda^2 = -w.
  EXPECT_NEAR(worst(0.6).real(), std::sqrt(Complex(-10.5, std::sqrt(0.55))).real(), 1e-13);
}

// With interface and neutral axis at the pivot friction passes through it: K is symmetric.
TEST(ModelB, NeverFluttersWithItsNeutralAxisAtThePivot)
{
  DynamicsMaker maker(false);
  for (const double mu : { 0.3, 0.73, 1., 1.2 })
    for (const double x : { 5., 25., 45., 65. })
      for (const auto direction : { Direction::forward, Direction::backward })
      {
        Scene scene                     = stability_scene(with_coulomb(model_b(), mu), ModelType::beam);
        scene.lever.neutral_axis_offset = 0.;
        for (const double depth : { 4., 8., 20. })
        {
          const auto found = check_slide(at(without_damping(with_depth(scene, depth)), x, direction), maker);
          EXPECT_EQ(found.kind, SlideKind::stable) << mu << " " << x << " " << depth;
          for (const auto &mode : found.modes)
            EXPECT_LT(std::abs(mode.mode.eigenvalue.real()), 1e-10 * std::abs(mode.mode.eigenvalue));
        }
      }
}

namespace
{
  /// The scene as a beam without modal damping, which slides at x = 65 mm.
  Scene undamped_beam(Scene scene, const Direction direction)
  {
    scene.analysis.model      = ModelType::beam;
    scene.analysis.type       = AnalysisType::stability;
    scene.lever.modal_damping = 0.;
    scene.stability.position  = 65.;
    scene.stability.direction = direction;
    return scene;
  }
} // namespace

// Without modal damping a beam of 20 mm has a growing mode above 100 kHz, which no lever has.
TEST(Beam, LeavesOutModesWithWavesShorterThanSixDepths)
{
  const Scene scene = undamped_beam(with_coulomb(model_a(), 0.73), Direction::backward);
  DynamicsMaker maker;
  const auto found = check_slide(scene, maker);
  EXPECT_EQ(found.kind, SlideKind::stable);
  // (2 pi / 6)^2 / (2 pi h) sqrt(E / (12 rho)), rho that of the whole section.
  EXPECT_NEAR(highest_beam_frequency(scene), 14393., 150.);
  EXPECT_LT(found.highest_frequency(), highest_beam_frequency(scene));
  ASSERT_TRUE(found.beyond);
  EXPECT_GT(found.beyond->mode.eigenvalue.imag() / (2. * M_PI), 1e5);
  EXPECT_GT(found.beyond->mode.eigenvalue.real(), 0.);
}

// The waves of this lever that grow lie within six depths but not within the beam's elements: one of 20 kHz is 24 mm long, an
// element 26 mm. The condensed lever decays by 0.022/s at 63.25 Hz.
TEST(Beam, LeavesOutModesWithWavesShorterThanItsElements)
{
  Scene scene             = undamped_beam(with_depth(with_coulomb(model_a(), 0.6), 3.), Direction::forward);
  scene.contact.stiffness = 9541.32;
  scene.contact.exponent  = 1.45485;
  DynamicsMaker maker;
  const auto found = check_slide(scene, maker);
  EXPECT_EQ(found.kind, SlideKind::stable);
  EXPECT_NEAR(found.growth_rate(), -0.02, 0.01);
  EXPECT_NEAR(found.frequency(), 63.25, 0.1);
  ASSERT_TRUE(found.beyond);
  EXPECT_NEAR(found.beyond->mode.eigenvalue.imag() / (2. * M_PI), 20026., 20.);
}

// With the mesh's neutral axis, behind the interface by the layer and half the depth, it can: 12 mm, mu 0.73, k_c = 1e4 N/mm,
// x = 44 backward grows by about 159/s at 778 Hz (a prototype's figures, three digits).
TEST(ModelB, FluttersWithAnAxisBehindTheInterfaceOnAStiffContact)
{
  DynamicsMaker maker(false);
  Scene scene             = stability_scene(with_depth(with_coulomb(model_b(), 0.73), 12.), ModelType::beam);
  scene.contact.stiffness = 1e4;
  const auto found        = check_slide(at(without_damping(scene), 44., Direction::backward), maker);
  EXPECT_EQ(found.kind, SlideKind::flutter);
  EXPECT_NEAR(found.growth_rate(), 159., 8.);
  EXPECT_NEAR(found.frequency(), 778., 8.);
}

namespace
{
  /// Each vibration below a frequency [Hz] is one of the others too, but for a share of its eigenvalue; returns their number.
  unsigned int expect_among(const std::vector<Eigenmode> &modes, const std::vector<Eigenmode> &others, const double highest,
                            const double share)
  {
    unsigned int compared = 0;
    for (const auto &mode : modes)
    {
      const Complex lambda = mode.mode.eigenvalue;
      if (lambda.imag() <= 0. || lambda.imag() > 2. * M_PI * highest)
        continue;
      double nearest = 1e300;
      for (const auto &other : others)
        nearest = std::min(nearest, std::abs(other.mode.eigenvalue - lambda));
      EXPECT_LT(nearest, share * std::abs(lambda)) << lambda;
      testing::Test::RecordProperty("difference_at_" + std::to_string(lambda.imag()),
                                    std::to_string(1e9 * nearest / std::abs(lambda)));
      ++compared;
    }
    return compared;
  }
} // namespace

// The condensed lever has 40 modes more than are compared: of these its static shapes leave out inertia worth (f/f_41)^4.
TEST(MeshedLever, UnderALawThatRisesWithSpeedCondensedVibratesAsTheFiniteElements)
{
  DynamicsMaker maker(false);
  for (const auto support : { SupportType::rigid, SupportType::sprung })
  {
    Scene scene           = with_depth(coarse(stability_scene(model_a(), ModelType::finite_element)), 6.);
    scene.support.type    = support;
    scene.condensed.modes = 40;
    scene.stability.modes = 6;
    const JudgedSlide held(scene);
    const auto &whole    = held.stability;
    const auto condensed = check_slide(stability_scene(scene, ModelType::condensed), maker);
    EXPECT_GT(std::abs(whole.worst_mode().growth.friction_speed), 10.);
    EXPECT_GE(expect_among(whole.modes, condensed.modes, 1e9, 1e-4), 6u);
  }
}

// Moving backwards from x = 65 undamped model A flutters when its lever is thinner than some 8.35 mm, in the beam on the contact
// law fitted to the mesh as in the mesh: all do at 8.2 mm and none at 8.6 mm.
TEST(ModelASlow, FluttersBelowTheSameDepthInEveryFlexibleModel)
{
  DynamicsMaker maker(false);
  for (const double depth : { 7., 8.2, 8.6 })
  {
    const Scene scene = without_damping(with_depth(stability_scene(with_coulomb(model_a(), 0.73), ModelType::beam), depth));
    const auto whole  = check_slide(stability_scene(scene, ModelType::finite_element), maker);
    for (const auto &other :
         { check_slide(stability_scene(scene, ModelType::condensed), maker), check_slide(with_fitted_law(scene), maker) })
    {
      EXPECT_EQ(other.kind, depth < 8.4 ? SlideKind::flutter : SlideKind::stable) << depth;
      EXPECT_EQ(other.kind, whole.kind) << depth;
      if (depth > 8.4)
        continue;
      EXPECT_NEAR(other.frequency(), whole.frequency(), 0.01 * whole.frequency()) << depth;
      EXPECT_NEAR(other.growth_rate(), whole.growth_rate(), 0.1 * whole.growth_rate()) << depth;
    }
  }
}
