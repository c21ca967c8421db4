// SPDX-License-Identifier: GPL-3.0-only
#include "fe/dynamics/solid_dynamics.h"

#include "fe/fields/body_fields.h"
#include "run_scene.h"
#include "scene/held_slide.h"
#include "scene/scene.h"
#include "scenes.h"
#include "verification/held_slides.h"
#include "verification/solid_steps.h"

#include <algorithm>
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

TEST(SolidInTime, AHeldSlideIsThatOfThePlane)
{
  DynamicsMaker maker(false);
  const Scene plane = held_model_a(2), solid = held_model_a(3);
  const auto plane_dynamics = maker.make(plane), solid_dynamics = maker.make(solid);
  const auto expected = plane_dynamics.model().hold(held_drive(plane), ContactFriction::sliding);
  const auto found    = solid_dynamics.model().hold(held_drive(solid), ContactFriction::sliding);
  ASSERT_TRUE(expected && found);
  EXPECT_NEAR(found->forces.P, expected->forces.P, 1e-5 * expected->forces.P);
  EXPECT_NEAR(found->forces.Q, expected->forces.Q, 1e-5 * std::abs(expected->forces.Q));
}

// Without contact, the first steps of a run in time are those of the plane; so is P as the lever is driven on.
class SolidRunInTime : public testing::TestWithParam<double>
{
};

INSTANTIATE_TEST_SUITE_P(From, SolidRunInTime, testing::Values(0., 20.));

TEST_P(SolidRunInTime, IsThatOfThePlane)
{
  const double start   = GetParam();
  const auto compute_P = [start](const unsigned int dimension)
  {
    Scene scene = held_model_a(dimension, AnalysisType::transient);
    scene.drive = Drive(DriveProfile::triangle, start, start + 4., 112., 0.5);
    std::vector<double> result;
    for (const Row &row : first_steps(scene))
      result.push_back(row[Column::P]);
    return result;
  };
  const auto plane = compute_P(2), solid = compute_P(3);
  ASSERT_EQ(plane.size(), solid.size());
  const double largest = *std::max_element(plane.begin(), plane.end());
  EXPECT_GT(largest, 0.5);
  for (std::size_t i = 0; i < plane.size(); ++i)
    EXPECT_NEAR(solid[i], plane[i], 1e-5 * largest) << i;
}

// A perturbation grows at the rate of its eigenvalue, up to the error of steps and of a nonlinear contact, see Growth.
TEST(SolidInTime, AVibrationGrowsAsItsEigenvalueSays)
{
  Scene scene              = held_model_a(3);
  scene.lever.depth        = 6.;
  scene.cylinder.tilt      = 1e-4;
  scene.stability.position = 65.;
  scene.analysis.type      = AnalysisType::sprag_slip;
  const JudgedSlide checked(scene);
  ASSERT_EQ(checked.stability.kind, SlideKind::flutter);
  HeldRun run(checked.dynamics.model(), checked.step());
  const auto growth = measure_growth(checked.dynamics.model(), checked.stability, scene.sprag_slip, run, [](const Row &) {});
  EXPECT_TRUE(growth.reached);
  EXPECT_TRUE(growth.slid);
  EXPECT_NEAR(growth.growth_difference(), 0., 0.003);
  EXPECT_NEAR(growth.frequency_difference(), 0., 0.0005);
}

// Modes leave out what the face does under its forces, which a back-substitution with the whole body adds; levers of as many
// modes move elsewhere alike as far as the plane has modes where space has sideways ones.
TEST(SolidInTime, ItsFieldsAreThoseOfThePlane)
{
  std::array<std::vector<BodyFields::Node>, 2> nodes;
  std::array<std::vector<NodalField>, 2> fields;
  for (const unsigned int dimension : { 2u, 3u })
  {
    Scene scene           = held_model_a(dimension, AnalysisType::transient);
    scene.drive           = Drive(DriveProfile::triangle, 20., 24., 112., 0.5);
    scene.condensed.modes = 20;
    DynamicsMaker maker(false);
    const auto dynamics = maker.make(scene);
    auto motion         = dynamics.model().initial_motion(scene.drive.at(0.));
    for (unsigned int i = 1; i <= 20; ++i)
      motion = dynamics.model().step(motion, scene.drive.at(i * 1e-4), StepWeights{ 1e-4, 0., 0., 0.25, 0.5 }).motion.value();
    const BodyFields body = dynamics.solid ? BodyFields(*dynamics.solid->body) : BodyFields(*dynamics.lever->body);
    nodes[dimension - 2]  = body.nodes;
    fields[dimension - 2] = body.at(dynamics.meshed.elastic_displacement(motion, 0));
  }
  double moved = 0., stressed = 0., displacement = 0., stress = 0.;
  for (unsigned int i = 0; i < nodes[1].size(); ++i)
  {
    const auto &node    = nodes[1][i];
    const auto is_below = [&](const BodyFields::Node &other)
    {
      return other.part == node.part && other.at_hub == node.at_hub && std::abs(other.position[0] - node.position[0]) < 1e-9 &&
             std::abs(other.position[1] - node.position[1]) < 1e-9;
    };
    const auto found = std::find_if(nodes[0].begin(), nodes[0].end(), is_below);
    ASSERT_NE(found, nodes[0].end());
    const auto &expected = fields[0][found - nodes[0].begin()];
    moved                = std::max(moved, expected.displacement.norm());
    stressed             = std::max(stressed, expected.stress.norm());
    displacement         = std::max(displacement, (fields[1][i].displacement - expected.displacement).norm());
    stress               = std::max(stress, (fields[1][i].stress - expected.stress).norm());
  }
  EXPECT_GT(stressed, 0.01);
  EXPECT_LT(displacement, 2e-4 * moved);
  EXPECT_LT(stress, 2e-4 * stressed);
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
