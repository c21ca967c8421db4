// SPDX-License-Identifier: GPL-3.0-only
#include "bar.h"
#include "fe/dynamics/condensed_basis.h"
#include "fe/dynamics/inertial_matrices.h"
#include "mpi_environment.h"
#include "support/root.h"

#include <cmath>
#include <gtest/gtest.h>

using namespace sprag;

namespace
{
  using Vector = dealii::Vector<double>;

  constexpr double young_modulus = 70000.;

  /// Slender and without a layer, its neutral axis through the pivot.
  Bar slender_bar()
  {
    return { 200., -2., 0., 4., 100, 2 };
  }

  double bar_mass(const Bar &bar)
  {
    return 2.7e-9 * bar.length * bar.depth * bar.width;
  }

  LeverModes compute_modes(const Bar &bar, const double tip_mass, const double spring, const unsigned int n)
  {
    const MeshedBar meshed(bar, 0.);
    const double L       = bar.length;
    const double rotary  = bar.depth * bar.depth / 12.;
    const double inertia = bar_mass(bar) * (L * L / 3. + rotary) + tip_mass * (L * L + rotary);
    return lever_modes(*meshed, make_response(*meshed), bar_inertia(inertia, tip_mass), spring, n);
  }

  /// omega of an Euler-Bernoulli beam with wave number `beta_length` over its length.
  double beam(const Bar &bar, const double beta_length)
  {
    const double bending = young_modulus * bar.width * std::pow(bar.depth, 3) / 12.;
    const double L       = bar.length;
    return beta_length * beta_length * std::sqrt(bending / (bar_mass(bar) * L * L * L));
  }

  /// Returns the relative decrease of omega of a beam between pins by rotary inertia and shear (Timoshenko): 1/2 (beta r)^2 (1
  /// + E/(kappa G)).
  double slenderness_error(const Bar &bar, const double beta_length)
  {
    const double beta_r = beta_length / bar.length * bar.depth / std::sqrt(12.);
    return 0.5 * beta_r * beta_r * (1. + 2. * 6. / 5.);
  }

  void expect_beam(const Bar &bar, const double omega_squared, const double beta_length, const double ends)
  {
    const double share = std::sqrt(omega_squared) / beam(bar, beta_length) - 1.;
    // The estimate is for sines; other ends bend more than a pinned one, and a tip mass has a rotary inertia of its own.
    EXPECT_LT(share, 0.);
    EXPECT_GT(share, -ends * slenderness_error(bar, beta_length)) << beta_length;
  }
} // namespace

TEST(LeverModes, OfAHingedBarAreThoseOfABeam)
{
  const Bar bar      = slender_bar();
  const double soft  = 10.;
  const auto modes   = compute_modes(bar, 0., soft, 4);
  const double J     = bar_mass(bar) * (bar.length * bar.length + 0.25 * bar.depth * bar.depth) / 3.;
  const double swing = soft / J;
  // Swinging it bends hardly: its frequency is 1/250 of the first one of bending. That the stiffness of 1e6 N/mm leaves a
  // rotation by 200 mm alone holds to round-off, 1e-16 (200 mm)^2 1e6 N/mm a node, beside the spring.
  EXPECT_NEAR(modes.stiffness[0], swing, 1e-3 * swing);
  for (unsigned int i = 1; i < 4; ++i)
  {
    const double estimate = (i + 0.25) * M_PI;
    const auto equation   = [](const double x) { return std::cos(x) * std::sinh(x) - std::sin(x) * std::cosh(x); };
    expect_beam(bar, modes.stiffness[i], root(equation, estimate - 0.2, estimate + 0.2), 1.5);
  }
}

// A beam hinged at one end with a mass mu times its own at the other: cot x - coth x = 2 mu x, x = beta L, between i pi and
// (i + 1/4) pi.
TEST(LeverModes, OfAHingedBarWithATipMassAreThoseOfABeam)
{
  const Bar bar    = slender_bar();
  const double mu  = 0.5;
  const auto modes = compute_modes(bar, mu * bar_mass(bar), 10., 4);
  for (unsigned int i = 1; i < 4; ++i)
  {
    const auto equation = [mu](const double x) { return std::cos(x) / std::sin(x) - 1. / std::tanh(x) - 2. * mu * x; };
    expect_beam(bar, modes.stiffness[i], root(equation, i * M_PI + 1e-6, (i + 0.25) * M_PI), 3.);
  }
}

TEST(LeverModes, OfAHeldBarAreThoseOfABeam)
{
  const Bar bar    = slender_bar();
  const auto modes = compute_modes(bar, 0., 1e12, 3);
  for (unsigned int i = 0; i < 3; ++i)
  {
    const double estimate = i == 0 ? 1.875 : (i + 0.5) * M_PI;
    const auto equation   = [](const double x) { return std::cos(x) + 1. / std::cosh(x); };
    expect_beam(bar, modes.stiffness[i], root(equation, estimate - 0.1, estimate + 0.1), 3.);
  }
}

TEST(LeverModes, AreOrthonormalAndTurnForward)
{
  const MeshedBar bar({});
  const auto inertia = bar_inertia(1e-3, 0.);
  const BodyMass<2> mass(*bar, inertia);
  // Few of them iteratively, all by the dense solver.
  for (const unsigned int n : { 10u, 1000000u })
  {
    const auto modes = lever_modes(*bar, make_response(*bar), inertia, 100., n);
    ASSERT_EQ(modes.stiffness.size(), std::min(n, TotalCoordinates(*bar).size()));
    std::vector<Vector> totals;
    for (unsigned int i = 0; i < modes.stiffness.size(); ++i)
    {
      totals.push_back(modes.displacements[i]);
      totals.back().add(modes.rotation[i], mass.arms);
      const auto momentum = mass(totals.back());
      for (unsigned int j = 0; j <= i; ++j)
        ASSERT_NEAR(totals[j] * momentum, i == j ? 1. : 0., 1e-9) << i << " " << j;
    }
    EXPECT_GT(modes.rotation[0], 0.);
    EXPECT_TRUE(std::is_sorted(modes.stiffness.begin(), modes.stiffness.end()));
  }
}
