// SPDX-License-Identifier: GPL-3.0-only
#include "model/structure/beam.h"

#include "scene/lever_inertia.h"
#include "scene/scene.h"
#include "scenes.h"
#include "support/free_frequencies.h"
#include "support/root.h"

#include <cmath>
#include <gtest/gtest.h>

using namespace sprag;

// Verification problem 10 for the beam elements. Natural frequencies of Euler-Bernoulli bars from their characteristic equations.

namespace
{
  constexpr unsigned int elements = 8;

  Scene bar(const double spring_stiffness, const double neutral_axis, const double tip_mass)
  {
    Scene scene                     = model_a();
    scene.analysis.model            = ModelType::beam;
    scene.spring.stiffness          = spring_stiffness;
    scene.lever.neutral_axis_offset = neutral_axis;
    scene.lever.tip_mass            = tip_mass;
    return scene;
  }

  BeamMesh make_beam_mesh(const Scene &scene, const unsigned int number = elements)
  {
    return { number, scene.lever.length };
  }

  double bending_stiffness(const Scene &scene)
  {
    return scene.lever.young_modulus * scene.lever.width * std::pow(scene.lever.depth, 3) / 12.;
  }

  /// Wave number of a frequency, times the length.
  double beta_L(const Scene &scene, const double omega)
  {
    return scene.lever.length * std::pow(omega * omega * mass_per_length(scene) / bending_stiffness(scene), 0.25);
  }

  /// With z = beta L, m = tip mass over the bar's, k = spring over EI/L, i = hub inertia over the bar's mass times L^2:
  ///   w = A sin + B sinh + C (cos - cosh),  w''(L) = 0,  w'''(L) = -m z^4 w(L),  w''(0) = (k - i z^4) w'(0),  lengths over L.
  double characteristic(const double z, const double m, const double k, const double i)
  {
    const double s = std::sin(z), c = std::cos(z), sh = std::sinh(z), ch = std::cosh(z);
    // Rows of the three conditions over (A, B, C), scaled.
    const double hub        = (k - i * z * z * z * z) / z;
    const double rows[3][3] = { { hub, hub, 2. },
                                { -s, sh, -c - ch },
                                { -c + m * z * s, ch + m * z * sh, s - sh + m * z * (c - ch) } };
    const auto minor        = [&](const unsigned int a, const unsigned int b)
    { return rows[1][a] * rows[2][b] - rows[1][b] * rows[2][a]; };
    return (rows[0][0] * minor(1, 2) - rows[0][1] * minor(0, 2) + rows[0][2] * minor(0, 1)) / (ch * (1. + std::abs(hub)));
  }

  /// Hermite elements with consistent mass are above the exact frequencies, by (beta h)^4/1440 of them to leading order; allowed
  /// is half as much again, and round-off.
  void expect_frequency(const Scene &scene, const double omega, const double exact)
  {
    const double found = beta_L(scene, omega);
    const double share = std::pow(exact / elements, 4) / 1440. / 2.;
    EXPECT_GT(found, exact * (1. - 1e-9)) << exact;
    EXPECT_LT(found, exact * (1. + 1.5 * share + 1e-9)) << exact;
  }
} // namespace

TEST(BeamFrequencies, OfBarsWithATipMass)
{
  for (const double share : { 0.1, 0.5 }) // of the moment of inertia
  {
    Scene scene          = bar(1e-6, 0., 0.);
    scene.lever.tip_mass = share * scene.lever.moment_of_inertia / (scene.lever.length * scene.lever.length);
    const double m       = scene.lever.tip_mass / (mass_per_length(scene) * scene.lever.length);
    // Pinned: coth z - cot z + 2 m z = 0.
    const auto pinned = [m](const double z) { return std::sin(z) / std::tanh(z) - std::cos(z) + 2. * m * z * std::sin(z); };
    // Clamped: 1 + cos cosh + m z (cos sinh - sin cosh) = 0.
    const auto clamped = [m](const double z)
    { return 1. / std::cosh(z) + std::cos(z) + m * z * (std::cos(z) * std::tanh(z) - std::sin(z)); };
    const auto frequencies = free_frequencies(scene, make_beam_mesh(scene));
    for (unsigned int i = 1; i < 4; ++i)
      expect_frequency(scene, frequencies[i], root(pinned, i * 3.14159, i * 3.14159 + 1.));
    scene.spring.stiffness = 1e16;
    const auto held        = free_frequencies(scene, make_beam_mesh(scene));
    const double before[]  = { 0.5, 3.2, 6.3 };
    const double behind[]  = { 1.9, 4.8, 7.9 };
    for (unsigned int i = 0; i < 3; ++i)
      expect_frequency(scene, held[i], root(clamped, before[i], behind[i]));
  }
}

TEST(BeamFrequencies, OfALeverOnItsSpringWithArmAndTipMass)
{
  for (const double arm : { 0., 45.6, 56.6 })
    for (const double tip_mass : { 0., 2e-5 })
      for (const double spring : { 7.4e4, 1e7 })
      {
        const Scene scene  = bar(spring, arm, tip_mass);
        const double L     = scene.lever.length;
        const double mass  = mass_per_length(scene) * L;
        const double m     = tip_mass / mass;
        const double k     = spring * L / bending_stiffness(scene);
        const double i     = (1. + m) * arm * arm / (L * L);
        const auto f       = [=](const double z) { return characteristic(z, m, k, i); };
        const auto found   = free_frequencies(scene, make_beam_mesh(scene));
        unsigned int count = 0;
        for (double z = 0.05; count < 4; z += 0.01)
          if ((f(z) > 0.) != (f(z + 0.01) > 0.))
            expect_frequency(scene, found[count++], root(f, z, z + 0.01));
      }
}

TEST(BeamMass, MeetsTheMomentOfInertiaExactly)
{
  for (const double arm : { 0., 45.6, 56.6 })
    for (const double tip_mass : { 0., 2e-5 })
    {
      Scene scene    = bar(7.4e4, arm, tip_mass);
      const double L = scene.lever.length;
      const double J = mass_per_length(scene) * (L * L * L / 3. + L * arm * arm) + tip_mass * (L * L + arm * arm);
      EXPECT_NEAR(J, 6.45, 1e-14);

      // A rigid lever's frequency has no other inertia: a million times stiffer, the beam bends by 1e-8 of its rotation. Momentum
      // of a unit rate of rotation along eta and xi.
      scene.support.type        = SupportType::sprung;
      scene.lever.young_modulus = 7e10;
      const auto data           = beam_modes(scene, make_beam_mesh(scene));
      EXPECT_NEAR(data.stiffness[0], 7.4e4 / 6.45, 1e-7 * data.stiffness[0]);
      const double turn = data.shapes(data.layout.rotation(), 0);
      EXPECT_NEAR(1. / (turn * turn), 6.45, 1e-6);
      const double mass = mass_per_length(scene) * L + tip_mass;
      EXPECT_NEAR(data.shapes(data.layout.momentum_eta(), 0) / turn, 0.5 * mass_per_length(scene) * L * L + tip_mass * L, 1e-7);
      EXPECT_NEAR(data.shapes(data.layout.momentum_xi(), 0) / turn, -arm * mass, 1e-9);
    }
}

TEST(BeamStatics, DeflectsAndTurnsAsBeamTheorySays)
{
  // Nodes of Hermite elements are exact under forces on nodes. Inverse stiffnesses of 1e-13 and more of 17 modes: round-off.
  const Scene scene = bar(7.4e4, 56.6, 0.);
  const double EI   = bending_stiffness(scene);
  const double L    = scene.lever.length;
  ModalStructure structure(beam_modes(scene, make_beam_mesh(scene)));
  structure.use_statics();
  const auto &compliance = structure.compliance();
  const unsigned int tip = 2 * elements - 2, hub = structure.layout().rotation();
  EXPECT_NEAR(compliance(tip, tip) / (L * L * L / (3. * EI)), 1., 1e-9);
  EXPECT_NEAR(compliance(tip + 1, tip) / (L * L / (2. * EI)), 1., 1e-9);
  EXPECT_NEAR(compliance(tip + 1, tip + 1) / (L / EI), 1., 1e-9);
  EXPECT_NEAR(compliance(hub, hub) * 7.4e4, 1., 1e-11);
  // In axes that turn with the hub a force on the lever does not turn it, its moment does.
  EXPECT_NEAR(compliance(hub, tip) / (L * L / (2. * EI)), 0., 1e-9);
  const double a = 0.5 * L; // node 4
  EXPECT_NEAR(compliance(2 * 4 - 2, tip) / (a * a * (3. * L - a) / (6. * EI)), 1., 1e-9);
}

TEST(BeamStatics, InPlaneStrainBendsAsAPlate)
{
  Scene scene          = bar(7.4e4, 56.6, 0.);
  scene.analysis.plane = PlaneState::strain;
  const double EI      = bending_stiffness(scene) / (1. - std::pow(scene.lever.poisson_ratio, 2));
  const double L       = scene.lever.length;
  ModalStructure structure(beam_modes(scene, make_beam_mesh(scene)));
  structure.use_statics();
  const unsigned int tip = 2 * elements - 2;
  EXPECT_NEAR(structure.compliance()(tip, tip) / (L * L * L / (3. * EI)), 1., 1e-9);
}

TEST(BeamDamping, IsTheShareOfCriticalOnBendingModesAlone)
{
  const Scene scene = bar(7.4e4, 56.6, 0.);
  const auto data   = beam_modes(scene, make_beam_mesh(scene));
  for (unsigned int i = 0; i < data.stiffness.size(); ++i)
    for (unsigned int j = 0; j < data.stiffness.size(); ++j)
      EXPECT_DOUBLE_EQ(data.damping(i, j), i == j && i > 0 ? 2. * 0.01 * std::sqrt(data.stiffness[i]) : 0.) << i << j;
}

TEST(BeamDamping, OfRayleighLeavesTheSpringOut)
{
  Scene scene                   = bar(7.4e4, 56.6, 0.);
  scene.lever.modal_damping     = 0.;
  scene.lever.mass_damping      = 3.;
  scene.lever.stiffness_damping = 1e-5;
  const auto data               = beam_modes(scene, make_beam_mesh(scene));
  for (unsigned int i = 0; i < 4; ++i)
    for (unsigned int j = 0; j < 4; ++j)
    {
      const double turns    = data.shapes(data.layout.rotation(), i) * data.shapes(data.layout.rotation(), j);
      const double expected = (i == j ? 3. + 1e-5 * data.stiffness[i] : 0.) - 1e-5 * 7.4e4 * turns;
      EXPECT_NEAR(data.damping(i, j), expected, 1e-12 * std::abs(expected) + 1e-13);
    }
  // A stiff lever keeps the mass' part alone.
  scene.lever.young_modulus *= 1e6;
  EXPECT_NEAR(beam_modes(scene, make_beam_mesh(scene)).damping(0, 0), 3., 1e-5);
}

TEST(BeamSupport, IsOneMoreModeOfFrameAndLeverOnTheirSpring)
{
  Scene scene        = bar(7.4e4, 56.6, 2e-5);
  scene.support.type = SupportType::sprung;
  const auto data    = beam_modes(scene, make_beam_mesh(scene));
  const double mass  = 2e-3 + mass_per_length(scene) * scene.lever.length + 2e-5;
  ASSERT_EQ(data.support, data.stiffness.size() - 1);
  EXPECT_NEAR(data.stiffness[data.support], 5000. / mass, 1e-9 * 5000. / mass);
  EXPECT_NEAR(data.damping(data.support, data.support), 2. * 0.02 * std::sqrt(5000. / mass), 1e-9);
  EXPECT_NEAR(data.shapes(data.layout.support(), data.support), 1. / std::sqrt(mass), 1e-9);
  for (unsigned int i = 0; i < data.support; ++i)
    EXPECT_EQ(data.shapes(data.layout.support(), i), 0.);
}
