#include "model/beam.h"

#include "scenes.h"

#include <cmath>
#include <functional>
#include <gtest/gtest.h>

using namespace sprag;

namespace
{
  constexpr unsigned int elements = 32;

  /// A bar on its pivot, the neutral axis through it; tip mass over the bar's own.
  Scene bar(const double spring, const double tip_mass_ratio)
  {
    Scene scene                     = model_a();
    const double mass               = 1e-3;
    const double length             = scene.lever.length;
    scene.spring_stiffness          = spring;
    scene.lever.neutral_axis_offset = 0.;
    scene.lever.tip_mass            = tip_mass_ratio * mass;
    scene.lever.moment_of_inertia   = mass * length * length * (1. / 3. + tip_mass_ratio);
    return scene;
  }

  /// omega of beta L, Euler-Bernoulli.
  double frequency(const Scene &scene, const double beta_length)
  {
    const Lever &lever   = scene.lever;
    const double bending = lever.young_modulus * lever.width * std::pow(lever.depth, 3) / 12.;
    return std::pow(beta_length / lever.length, 2) * std::sqrt(bending * lever.length / 1e-3);
  }

  double root(const std::function<double(double)> &f, double lower, double upper)
  {
    for (unsigned int i = 0; i < 100; ++i)
    {
      const double middle                         = 0.5 * (lower + upper);
      (f(middle) * f(lower) > 0. ? lower : upper) = middle;
    }
    return lower;
  }

  double pinned(const double b, const double mu)
  {
    return std::sin(b) / std::tanh(b) - std::cos(b) + 2. * mu * b * std::sin(b);
  }

  double clamped(const double b, const double mu)
  {
    return 1. / std::cosh(b) + std::cos(b) + mu * b * (std::cos(b) * std::tanh(b) - std::sin(b));
  }

  // Hermite elements of length h with consistent mass overestimate omega by (beta h)^4 / 1440.
  void expect_frequency(const Scene &scene, const double found, const double beta_length)
  {
    const double exact = frequency(scene, beta_length);
    const double error = std::pow(beta_length / elements, 4) / 1440.;
    EXPECT_NEAR(found, exact, (1.5 * error + 1e-6) * exact) << "beta L = " << beta_length;
  }
} // namespace

TEST(Beam, PinnedFreeBarHasItsFrequencies)
{
  for (const double mu : { 0., 0.5 })
  {
    const Scene scene = bar(1e-3, mu);
    const auto found  = free_frequencies(scene, { elements, scene.lever.length });
    for (unsigned int i = 1; i <= 3; ++i)
    {
      const double pi = std::acos(-1.);
      const auto f    = [mu](const double b) { return pinned(b, mu); };
      expect_frequency(scene, found[i], root(f, (i - 0.05) * pi, (i + 0.45) * pi));
    }
  }
}

// A spring of 1e14 N mm/rad gives way by EI/(k L) = 9e-8 of what the bar does.
TEST(Beam, ClampedBarHasItsFrequencies)
{
  for (const double mu : { 0., 0.5 })
  {
    const Scene scene = bar(1e14, mu);
    const auto found  = free_frequencies(scene, { elements, scene.lever.length });
    const double pi   = std::acos(-1.);
    for (unsigned int i = 0; i < 3; ++i)
    {
      const auto f = [mu](const double b) { return clamped(b, mu); };
      expect_frequency(scene, found[i], root(f, i == 0 ? 0.5 : (i + 0.05) * pi, (i + 0.95) * pi));
    }
  }
}

// Without bending nothing but the spring and J are left.
TEST(Beam, SlowestModeIsTheLeverOnItsSpring)
{
  Scene scene = model_a();
  scene.lever.young_modulus *= 1e4;
  for (const double tip_mass : { 0., 2e-5 })
  {
    scene.lever.tip_mass = tip_mass;
    const double omega   = std::sqrt(scene.spring_stiffness / scene.lever.moment_of_inertia);
    EXPECT_NEAR(free_frequencies(scene, { 8, scene.lever.length })[0], omega, 1e-6 * omega);
    EXPECT_NEAR(free_frequencies(scene, { 0, scene.lever.length })[0], omega, 1e-12 * omega);
  }
}
