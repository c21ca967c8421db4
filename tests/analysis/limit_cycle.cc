// SPDX-License-Identifier: GPL-3.0-only
#include "analysis/limit_cycle/limit_cycle.h"

#include <cmath>
#include <gtest/gtest.h>

using namespace sprag;

namespace
{
  constexpr double growth    = 80.;
  constexpr double frequency = 200.;

  /// exp(g t) cos(2 pi f t + phase) in steps, a number a period.
  std::vector<Sample> growing(const unsigned int per_period, const double phase, const double duration = 0.1)
  {
    std::vector<Sample> signal;
    const double dt = 1. / (frequency * per_period);
    for (double time = 0.; time < duration; time += dt)
      signal.push_back({ time, std::exp(growth * time) * std::cos(2. * M_PI * frequency * time + phase) });
    return signal;
  }
} // namespace

// The extrema of exp(g t) cos(w t + p) lie where tan(w t + p) = g / w, all by the same factor below the envelope. Between samples
// the parabola misses them by a part of (2 pi / n)^4 that depends on where the samples lie.
TEST(Envelope, FollowsExponentialGrowth)
{
  const double omega = 2. * M_PI * frequency;
  for (const unsigned int n : { 16u, 50u, 128u })
    for (const double phase : { 0., 0.3, 1., 2.5 })
    {
      const auto fit = fit_exponential(compute_envelope(growing(n, phase)));
      const double h = 2. * M_PI / n;
      EXPECT_NEAR(fit.rate, growth, growth * h * h * h * h) << n << ' ' << phase;
      EXPECT_NEAR(fit.amplitude, 1. / std::hypot(1., growth / omega), h * h * h * h) << n << ' ' << phase;
      EXPECT_LT(fit.scatter, h * h * h * h) << n << ' ' << phase;
    }
}

TEST(Envelope, ScatterTellsAnythingButAnExponential)
{
  std::vector<Sample> sizes;
  for (unsigned int i = 0; i < 100; ++i)
    sizes.push_back({ i * 0.01, std::exp(i % 2 == 0 ? 0.1 : -0.1) });
  // Alternating 0.1 about a mean of 0; the slope of such a row of n is 0.6 / n^2 a step and takes 3/n^2 of the squares.
  EXPECT_NEAR(fit_exponential(sizes).scatter, 0.1, 1e-4);
  EXPECT_NEAR(fit_exponential(sizes).rate, 0., 0.01);
}

TEST(Envelope, TooLittleIsNotAnAnswer)
{
  EXPECT_TRUE(std::isnan(fit_exponential({ { 0., 1. }, { 1., 2. } }).rate));
  EXPECT_TRUE(std::isnan(fit_frequency({ 0., 1. })));
  EXPECT_TRUE(compute_envelope({}).empty());
  EXPECT_TRUE(compute_envelope({ { 0., 1. }, { 1., 2. } }).empty());
}
