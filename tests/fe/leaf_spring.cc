// SPDX-License-Identifier: GPL-3.0-only
#include "fe/leaf/leaf_spring.h"

#include "base/errors.h"
#include "fe/leaf/leaf_body.h"
#include "leaf_beam.h"
#include "mpi_environment.h"
#include "scene/closed_form.h"
#include "scene/scene.h"
#include "scenes.h"
#include "support/root.h"

#include <algorithm>
#include <gtest/gtest.h>

using namespace sprag;

namespace
{
  constexpr double pi = dealii::numbers::PI;

  /// The discretisation error of stiffnesses on the default mesh.
  constexpr double mesh_tolerance = 2.5e-4;

  LeafSpring make_leaf(const LeafEnd end, const double thickness, const double poisson_ratio = 0.)
  {
    LeafSpring leaf;
    leaf.end           = end;
    leaf.thickness     = thickness;
    leaf.poisson_ratio = poisson_ratio;
    return leaf;
  }

  const std::vector<LeafEnd> ends = { LeafEnd::clamped, LeafEnd::pinned, LeafEnd::guided };

  /// Integral over the length by Simpson's rule.
  double integral(const LeafSpring &leaf, const std::function<double(double)> &f)
  {
    const unsigned int n = 200;
    const double h       = leaf.length / n;
    double sum           = 0.;
    for (unsigned int i = 0; i <= n; ++i)
      sum += (i == 0 || i == n ? 1. : i % 2 == 1 ? 4. : 2.) * f(i * h) * h / 3.;
    return sum;
  }
} // namespace

// Without Poisson's ratio, which a clamp hinders, the plane solid is a beam with shear up to the clamp. What is left is the mesh.
TEST(LeafSpring, StiffnessIsThatOfBeamTheory)
{
  for (const LeafEnd end : ends)
    for (const double thickness : { 1., 1.4, 2. })
      for (const double distance : { 0., 12. })
      {
        LeafSpring leaf       = make_leaf(end, thickness);
        leaf.clamp_distance   = distance;
        const double expected = beam_stiffness(leaf);
        EXPECT_NEAR(LeafBody(leaf, PlaneState::stress).rest().stiffness, expected, mesh_tolerance * expected);
      }
}

// A clamp that lets no section narrow makes EI larger by nu^2/(1 - nu^2) next to it, over less than half of the thickness. Of the
// flexibility that length has the share M^2 over its mean: 4 and 1 at the ends of a clamped leaf, 3 and 0, 1 and 1.
TEST(LeafSpring, ClampsStiffenALittleByPoissonsRatio)
{
  const std::vector<double> shares = { 5., 3., 2. };
  for (unsigned int i = 0; i < 3; ++i)
  {
    const LeafSpring leaf = make_leaf(ends[i], 1.4, 0.3);
    const double more     = LeafBody(leaf, PlaneState::stress).rest().stiffness / beam_stiffness(leaf) - 1.;
    EXPECT_GT(more, 0.);
    EXPECT_LE(more, shares[i] * 0.09 / 0.91 * 0.5 * leaf.thickness / leaf.length + mesh_tolerance);
  }
}

// Slip of the law between samples: 1e-8 of the largest moment, checked where cubic interpolation errs most, half way.
TEST(LeafSpring, LawMeetsFiniteElementsBetweenSamples)
{
  for (const LeafAxial axial : { LeafAxial::free, LeafAxial::held })
    for (const double sagitta : { 0., 1.5 })
    {
      LeafSpring leaf = make_leaf(LeafEnd::clamped, 1.4, 0.3);
      leaf.axial      = axial;
      leaf.sagitta    = sagitta;
      const auto law  = leaf_behaviour(leaf, PlaneState::stress, -0.02, 0.03).law;
      const auto &all = law.samples();
      EXPECT_EQ(all.front().turn, -0.02);
      EXPECT_EQ(all.back().turn, 0.03);
      EXPECT_EQ(law.moment(0.), 0.);
      EXPECT_EQ(law.stiffness(0.), law.linear_stiffness());
      LeafBody body(leaf, PlaneState::stress);
      const double largest = std::max(std::abs(all.front().moment), all.back().moment);
      for (std::size_t i = 0; i + 1 < all.size(); i += 3)
      {
        const double turn = 0.5 * (all[i].turn + all[i + 1].turn);
        const auto state  = body.steps(body.rest(), turn).back();
        EXPECT_NEAR(law.moment(turn), state.moment, 1e-8 * largest) << turn;
        // Work done on the hub is strain energy: the integral of the same error.
        EXPECT_NEAR(law.energy(turn), body.body().energy(state.displacement), 1e-8 * largest * 0.03) << turn;
      }
    }
}

// Central differences: with the axial force of a held leaf the stiffness grows by k (turn/0.05)^2 or so, M''' is some 1e3 k.
TEST(LeafSpring, StiffnessIsTheDerivativeOfTheMoment)
{
  for (const LeafEnd end : ends)
    for (const LeafAxial axial : { LeafAxial::free, LeafAxial::held })
    {
      LeafSpring leaf = make_leaf(end, 1.4, 0.3);
      leaf.axial      = axial;
      leaf.sagitta    = 0.5;
      LeafBody body(leaf, PlaneState::stress);
      const auto at = body.steps(body.rest(), 0.02).back();
      for (const double h : { 1e-4, 5e-5 })
      {
        const double right = body.state(at.turn + h, at.displacement).moment;
        const double left  = body.state(at.turn - h, at.displacement).moment;
        EXPECT_NEAR((right - left) / (2. * h), at.stiffness, (1e3 * h * h + 1e-11 / h) * at.stiffness);
      }
    }
}

// The elastica leaves out shear, 12 EI/(kappa G A L^2), its strain is the engineering one where the solid has Green's (some 1e-4
// here), and the arc's thickness counts by (t/R)^2.
TEST(LeafSpring, BentAndHeldLeavesMeetTheExtensibleElastica)
{
  for (const LeafEnd end : ends)
    for (const LeafAxial axial : { LeafAxial::free, LeafAxial::held })
      for (const double sagitta : { 0., 1., -1. })
        for (const double distance : { 0., 8. })
        {
          LeafSpring leaf     = make_leaf(end, 1.);
          leaf.axial          = axial;
          leaf.sagitta        = sagitta;
          leaf.clamp_distance = distance;
          LeafBody body(leaf, PlaneState::stress);
          ExtensibleElastica elastica(leaf);
          const double allowed = shear_number(leaf) + mesh_tolerance + 1e-4;
          for (const double turn : { -0.02, 0.001, 0.03 })
          {
            const double expected = elastica.moment(turn);
            EXPECT_NEAR(body.steps(body.rest(), turn).back().moment, expected, allowed * std::abs(expected))
                << "end " << static_cast<int>(end) << " axial " << static_cast<int>(axial) << " sagitta " << sagitta
                << " distance " << distance << " turn " << turn;
          }
        }
}

// Held by the hub: wave numbers beta L of clamped-clamped, clamped-pinned and clamped-guided beams. Shear and rotary inertia
// lower a frequency by about 1/2 (beta r)^2 (1 + E/(kappa G)), r^2 = t^2/12, and no more than twice that.
TEST(LeafSpring, VibratesLikeABeam)
{
  const std::vector<std::function<double(double)>> equations = {
    [](const double b) { return std::cos(b) - 1. / std::cosh(b); },
    [](const double b) { return std::sin(b) - std::cos(b) * std::tanh(b); },
    [](const double b) { return std::sin(b) + std::cos(b) * std::tanh(b); },
  };
  const std::vector<double> lowest = { 1.5 * pi, 1.25 * pi, 0.75 * pi };
  for (unsigned int i = 0; i < 3; ++i)
  {
    const LeafSpring leaf        = make_leaf(ends[i], 1.);
    const auto behaviour         = leaf_behaviour(leaf, PlaneState::stress, -0.01, 0.01);
    const double mass_per_length = leaf.density * leaf.width * leaf.thickness;
    ASSERT_EQ(behaviour.modes.size(), 8u);
    for (unsigned int mode = 0; mode < 3; ++mode)
    {
      const double guess      = lowest[i] + mode * pi;
      const double b          = root(equations[i], guess - 0.4, guess + 0.4);
      const double omega      = b * b / (leaf.length * leaf.length) * std::sqrt(bending_stiffness(leaf) / mass_per_length);
      const double slender    = b * leaf.thickness / leaf.length;
      const double correction = slender * slender / 12. * (1. + 2.4);
      EXPECT_NEAR(std::sqrt(behaviour.modes[mode].stiffness), omega, (correction + mesh_tolerance) * omega) << mode;
    }
    // Along the leaf a rod clamped at one end, under an end that counts for nothing.
    const double rod = 0.5 * pi / leaf.length * std::sqrt(leaf.young_modulus / leaf.density);
    EXPECT_TRUE(std::any_of(behaviour.modes.begin(), behaviour.modes.end(),
                            [&](const auto &mode) { return std::abs(std::sqrt(mode.stiffness) / rod - 1.) < 1e-4; }));
  }
}

// The static shape of a beam, which shear changes by the shear number, and the rotary inertia, of order (t/L)^2.
TEST(LeafSpring, InertiaIsThatOfItsStaticShape)
{
  for (const LeafEnd end : ends)
    for (const double distance : { 0., 12. })
    {
      LeafSpring leaf              = make_leaf(end, 1.);
      leaf.clamp_distance          = distance;
      const auto behaviour         = leaf_behaviour(leaf, PlaneState::stress, -0.01, 0.01);
      const double mass_per_length = leaf.density * leaf.width * leaf.thickness;
      const double inertia = mass_per_length * integral(leaf, [&](const double x) { return std::pow(static_shape(leaf, x), 2); });
      const double momentum = -mass_per_length * integral(leaf, [&](const double x) { return static_shape(leaf, x); });
      const double allowed  = 3. * shear_number(leaf) + mesh_tolerance;
      EXPECT_NEAR(behaviour.mass, mass_per_length * leaf.length, 1e-12 * behaviour.mass);
      EXPECT_NEAR(behaviour.inertia, inertia, allowed * inertia);
      EXPECT_NEAR(behaviour.momentum[1], momentum, allowed * std::abs(momentum));
      EXPECT_NEAR(behaviour.momentum[0], 0., 1e-9 * std::abs(momentum));
    }
}

// With the clamp at the pivot the static shape does not move where the modes do not, so all modes together have its inertia and
// momentum; the n-th one has a share of about 1/n^4 or n^6, beyond eight nothing much.
TEST(LeafSpring, ModesTakePartInWhatTheHubMoves)
{
  for (const LeafEnd end : { LeafEnd::clamped, LeafEnd::pinned })
  {
    const auto behaviour = leaf_behaviour(make_leaf(end, 1.), PlaneState::stress, -0.01, 0.01);
    double inertia = 0., momentum = 0.;
    for (const auto &mode : behaviour.modes)
    {
      inertia += mode.participation * mode.participation;
      momentum += mode.participation * mode.momentum[1];
    }
    EXPECT_LE(inertia, behaviour.inertia);
    EXPECT_GE(inertia, 0.99 * behaviour.inertia);
    EXPECT_NEAR(momentum, behaviour.momentum[1], 0.02 * std::abs(behaviour.momentum[1]));
  }
}

TEST(LeafSpring, ThePlaneOfTheLeverLeavesItAlone)
{
  Scene scene          = model_a();
  scene.spring.type    = SpringType::leaf;
  const double as_beam = prepared_spring(scene).stiffness;
  scene.analysis.plane = PlaneState::strain;
  EXPECT_EQ(prepared_spring(scene).stiffness, as_beam);
  auto &leaf            = scene.spring.leaf;
  leaf.plane            = PlaneState::strain;
  const double as_plate = prepared_spring(scene).stiffness;
  EXPECT_NEAR(as_plate / as_beam * (1. - leaf.poisson_ratio * leaf.poisson_ratio), 1., 2e-3); // the clamps hinder both
}

// The joint of an arch, held along it, moves across. Its moment falls beyond a turn of 0.07 rad, which round-off must not end.
TEST(LeafSpring, ArchBeyondItsLargestMoment)
{
  LeafSpring leaf;
  leaf.thickness      = 0.5;
  leaf.sagitta        = 10.;
  leaf.end            = LeafEnd::guided;
  leaf.axial          = LeafAxial::held;
  const MomentLaw law = leaf_behaviour(leaf, PlaneState::stress, -0.01, 0.2).law;
  const auto &all     = law.samples();
  EXPECT_LT(law.moment(0.2), 0.9 * law.moment(0.07));
  // The trapezoidal rule errs by the square of the steps.
  for (std::size_t i = 1; i < all.size(); ++i)
    EXPECT_NEAR(all[i].moment - all[i - 1].moment,
                0.5 * (all[i].stiffness + all[i - 1].stiffness) * (all[i].turn - all[i - 1].turn), 1e-3 * law.moment(0.07));
}
