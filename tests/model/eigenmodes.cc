// SPDX-License-Identifier: GPL-3.0-only
#include "model/structure/eigenmodes.h"

#include "model/contact/point_contact.h"
#include "model/lever/reduced_lever.h"
#include "model/structure/beam.h"
#include "scene/closed_form.h"
#include "scene/held_slide.h"
#include "scene/scene.h"
#include "scenes.h"
#include "support/free_frequencies.h"

#include <cmath>
#include <gtest/gtest.h>

using namespace sprag;

namespace
{
  using Complex = std::complex<double>;

  Scene lever_scene(const ModelType model, const bool sprung)
  {
    Scene scene             = model_a();
    scene.analysis.model    = model;
    scene.support.type      = sprung ? SupportType::sprung : SupportType::rigid;
    scene.lever.depth       = 6.;
    scene.contact.stiffness = 10451.;
    scene.contact.exponent  = 1.4726;
    return scene;
  }

  Scene undamped(Scene scene)
  {
    scene.stability.damping = false;
    return held_scene(scene);
  }

  std::vector<Scene> levers()
  {
    return { lever_scene(ModelType::rigid, false), lever_scene(ModelType::rigid, true), lever_scene(ModelType::beam, false),
             lever_scene(ModelType::beam, true) };
  }

  DrivePoint drive(const double x, const double direction)
  {
    return { 0., x, direction * 112., 0. };
  }

  HeldSlide held(DynamicModel &model, const DrivePoint &at, const ContactFriction friction = ContactFriction::sliding)
  {
    const auto slide = model.hold(at, friction);
    EXPECT_TRUE(slide);
    return *slide;
  }

  double sum(const GrowthShares &g)
  {
    return g.friction_rotation + g.friction_bending + g.friction_support + g.friction_speed + g.contact_damping +
           g.structure_damping;
  }

  double sum(const EnergyShares &e)
  {
    return e.rotation + e.bending + e.support + e.contact;
  }

  std::vector<Eigenmode> modes_at(const Scene &scene, const double x, const double direction,
                                  const ContactFriction friction = ContactFriction::sliding)
  {
    const auto model = make_reduced_lever(scene);
    return model->vibrations(held(*model, drive(x, direction), friction), true, 10);
  }

  /// Two levers with two surface dofs and a rotation each.
  InterfaceLayout two_levers()
  {
    InterfaceLayout layout;
    layout.surface = 2;
    layout.levers  = 2;
    return layout;
  }

  ComplexVector make_vector(const std::vector<Complex> &values)
  {
    ComplexVector result;
    for (auto &part : result)
      part.reinit(static_cast<unsigned int>(values.size()));
    for (unsigned int i = 0; i < values.size(); ++i)
    {
      result[0][i] = values[i].real();
      result[1][i] = values[i].imag();
    }
    return result;
  }

  std::vector<Complex> sum(const Complex a, const std::vector<Complex> &x, const Complex b, const std::vector<Complex> &y)
  {
    std::vector<Complex> result;
    for (std::size_t i = 0; i < x.size(); ++i)
      result.push_back(a * x[i] + b * y[i]);
    return result;
  }

  const std::vector<Complex> first_moves  = { { 1., 0.5 }, { -0.3, 2. }, 0.7, 0., 0., 0. };
  const std::vector<Complex> second_moves = { 0., 0., 0., { 1., 0.5 }, { -0.3, 2. }, 0.7 };

  struct Pair
  {
    std::vector<StructureMode> modes;
    std::vector<ComplexVector> displacements;
  };

  /// Coordinates are the dofs.
  Pair make_mode_pair(const std::vector<Complex> &a, const std::vector<Complex> &b, const Complex other_eigenvalue = { -1., 50. })
  {
    Pair result;
    for (const auto *const values : { &a, &b })
    {
      StructureMode mode;
      mode.eigenvalue  = values == &a ? Complex(-1., 50.) : other_eigenvalue;
      mode.coordinates = make_vector(*values);
      result.modes.push_back(mode);
      result.displacements.push_back(make_vector(*values));
    }
    return result;
  }
} // namespace

// Everything is on: damping of lever, contact and support, mu(v) behind the spring of stick, friction. The parts are quadratic
// forms of round-off 1e-16 of their terms, of which the largest are lambda times the energies; a traction that is delayed is
// divided by 1 + lambda time, a hundredth or less at the eigenvalue that the delay itself brings along, whose own round-off of
// some 1e-12 counts as much more.
TEST(Growth, SharesAddUp)
{
  for (const auto &scene : levers())
    for (const double direction : { 1., -1. })
      for (const double x : { 10., 65. })
      {
        const auto modes = modes_at(scene, x, direction);
        EXPECT_FALSE(modes.empty());
        for (const auto &mode : modes)
        {
          const Complex lambda = mode.mode.eigenvalue;
          EXPECT_NEAR(sum(mode.growth), lambda.real(), 5e-10 * std::abs(lambda)) << lambda;
          EXPECT_NEAR(sum(mode.energy), 1., 1e-12);
          EXPECT_LT(mode.growth.structure_damping, 0. + 1e-300);
          EXPECT_LE(mode.growth.contact_damping, 0.);
          EXPECT_LT(mode.mode.residual, 2e-10) << lambda; // round-off, up to 1.3e-10
        }
      }
}

TEST(Growth, OnlyDampingIsLeftWithoutFriction)
{
  for (const auto &scene : levers())
  {
    const auto modes = modes_at(scene, 65., -1., ContactFriction::none);
    EXPECT_FALSE(modes.empty());
    for (const auto &mode : modes)
    {
      EXPECT_EQ(mode.growth.friction_rotation, 0.);
      EXPECT_EQ(mode.growth.friction_bending, 0.);
      EXPECT_EQ(mode.growth.friction_support, 0.);
      EXPECT_EQ(mode.growth.friction_speed, 0.);
      EXPECT_LT(mode.mode.eigenvalue.real(), 0.);
    }
  }
}

// A flutter of the undamped lever under constant mu is fed by friction as it follows displacements and by nothing else.
TEST(Growth, OfAnUndampedFlutterIsFrictions)
{
  const auto modes = modes_at(undamped(with_coulomb(lever_scene(ModelType::beam, false), 0.73)), 65., -1.);
  double largest   = 0.;
  for (const auto &mode : modes)
  {
    EXPECT_EQ(mode.growth.friction_speed, 0.);
    EXPECT_EQ(mode.growth.contact_damping, 0.);
    EXPECT_EQ(std::abs(mode.growth.structure_damping), 0.);
    largest = std::max(largest, mode.growth.friction_rotation + mode.growth.friction_bending);
  }
  EXPECT_GT(largest, 50.);
}

TEST(Vibrations, OutOfContactAreThoseOfTheFreeLever)
{
  const Scene scene = undamped(lever_scene(ModelType::beam, false));
  const auto model  = make_reduced_lever(scene);
  const auto modes  = model->vibrations(held(*model, drive(65., -1.)), false, 10);
  const auto free   = free_frequencies(scene, { beam_elements, scene.lever.length });
  ASSERT_EQ(modes.size(), free.size());
  for (std::size_t i = 0; i < free.size(); ++i)
  {
    // Seen beside the highest, 1e7 rad/s, whose square is 1e10 times that of the lowest.
    EXPECT_NEAR(modes[i].mode.eigenvalue.imag(), free[i], 1e-12 * free[i]) << i;
    EXPECT_EQ(modes[i].energy.contact, 0.);
  }
}

// Moments about the pivot: k (theta - theta_0) = P (s + sigma mu e R/(R - delta)), P = k_c delta. And its derivatives:
// det(1 - G df/dz) = 1 - dM/dtheta / k, with d(delta)/d(theta) = -s and ds/d(theta) = -(R - e - delta) for h = 0.
TEST(HeldSlide, OfARigidLeverIsTheEquilibriumOfMoments)
{
  Scene scene            = held_scene(model_a());
  scene.analysis.model   = ModelType::rigid;
  const auto model       = make_reduced_lever(scene);
  const double R         = scene.geometry.cylinder_radius;
  const double e         = scene.geometry.interface_offset;
  const double k         = scene.spring.stiffness;
  const double stiffness = scene.contact.stiffness;
  const double rest      = kinematics(scene.geometry, 0.).theta;
  for (const double x : { 5., 30., 65. })
    for (const double direction : { 1., -1. })
    {
      const auto slide   = held(*model, drive(x, direction));
      const double delta = slide.penetration;
      const double theta = rest + slide.displacements[0];
      const double s     = (scene.geometry.pivot_distance - x) * std::cos(theta);
      const double share = direction * slide.mu * e;
      const double P     = stiffness * delta;
      // The penetration has the round-off of the gap, 3e-14 mm.
      EXPECT_NEAR(delta, R - e - (scene.geometry.pivot_distance - x) * std::sin(theta), 1e-13);
      EXPECT_NEAR(k * slide.displacements[0], P * (s + share * R / (R - delta)), 1e-8 * k * slide.displacements[0]);

      const double slope_normal   = -stiffness * s * s - P * (R - e - delta);
      const double slope_friction = -share * (stiffness * s * R / (R - delta) + P * s * R / ((R - delta) * (R - delta)));
      EXPECT_NEAR(slide.uniqueness, (k - slope_normal - slope_friction) / (k - slope_normal), 1e-11);
      // In the limit of a stiff contact (s + sigma mu e)/s; the spring and the contact's yield leave these.
      EXPECT_NEAR(slide.uniqueness, 1. + share / s, std::abs(share / s) * (k / (stiffness * s * s) + 2. * delta / (R - e)));
      EXPECT_NEAR(held(*model, drive(x, direction), ContactFriction::none).uniqueness, 1., 1e-15);
    }
}

TEST(ModeSymmetry, IsOneOrMinusOneOfLeversThatMoveAlike)
{
  EXPECT_NEAR(symmetric_share(make_vector(sum(1., first_moves, 1., second_moves)), two_levers()), 1., 1e-15);
  EXPECT_NEAR(symmetric_share(make_vector(sum(1., first_moves, -1., second_moves)), two_levers()), -1., 1e-15);
  EXPECT_NEAR(symmetric_share(make_vector(first_moves), two_levers()), 0., 1e-15);
}

// Any two combinations of what two levers do alone are modes of one eigenvalue.
TEST(ModeSymmetry, TiedModesAreToldApartByIt)
{
  for (const Complex factor : { Complex(0., 0.), Complex(0.4, 0.), Complex(-0.2, 3.), Complex(1., 1e-9) })
  {
    auto pair =
        make_mode_pair(sum(1., first_moves, factor, second_moves), sum({ 0.3, 0.7 }, first_moves, { -2., 1. }, second_moves));
    separate_ties(pair.modes, pair.displacements, two_levers());
    EXPECT_NEAR(symmetric_share(pair.displacements[0], two_levers()), 1., 1e-12);
    EXPECT_NEAR(symmetric_share(pair.displacements[1], two_levers()), -1., 1e-12);
    for (unsigned int k = 0; k < 2; ++k)
      for (unsigned int part = 0; part < 2; ++part)
      {
        auto difference = pair.modes[k].coordinates[part];
        difference -= pair.displacements[k][part];
        EXPECT_LE(difference.linfty_norm(), 1e-14);
      }
  }
}
