// SPDX-License-Identifier: GPL-3.0-only
#include "fe/contact/pressure_recovery.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

using namespace sprag;

namespace
{
  /// A face from -3 to 3 mm whose cells are as long as told.
  PressureSamples sampled(const std::function<double(double)> &pressure, const double cell = 0.35)
  {
    PressureSamples result;
    constexpr unsigned int n = 480;
    result.begin             = -3.;
    result.end               = 3.;
    for (unsigned int i = 0; i < n; ++i)
    {
      result.xi.push_back(-3. + 6. * (i + 0.5) / n);
      result.weight.push_back(40. * 6. / n);
      result.pressure.push_back(std::max(0., pressure(result.xi.back())));
      result.trial.push_back(result.pressure.back() > 0. ? result.pressure.back() : -0.1);
      result.cell.push_back(static_cast<unsigned int>((result.xi.back() + 3.) / cell));
    }
    return result;
  }

  double ellipse(const double s)
  {
    return s * s < 1. ? std::sqrt(1. - s * s) : 0.;
  }

  double moment(const PressureSamples &samples, const std::vector<double> &pressure, const int power)
  {
    double result = 0.;
    for (std::size_t i = 0; i < pressure.size(); ++i)
      result += samples.weight[i] * pressure[i] * std::pow(samples.xi[i], power);
    return result;
  }

  // Largest pressure and width of a contact from 0.2 to 1.6 mm; the samples are 0.009 of its width apart.
  void expect(const std::function<double(double)> &profile, const double largest, const double tolerance)
  {
    const auto samples = sampled([&](const double xi) { return profile((xi - 0.9) / 0.7); });
    const auto result  = recover(samples);
    ASSERT_TRUE(result.is_fitted);
    EXPECT_NEAR(result.largest / largest, 1., tolerance);
    EXPECT_NEAR(result.width / 1.4, 1., 0.018); // the distance of the samples; m comes in steps of 1/4
    for (const int power : { 0, 1 })
      EXPECT_NEAR(moment(samples, result.pressure, power) / moment(samples, samples.pressure, power), 1., 1e-12);
  }
} // namespace

TEST(PressureRecovery, MeetsEllipseParabolaAndWhatLiesBetween)
{
  expect(ellipse, 1., 5e-3);
  expect([](const double s) { return 1. - s * s; }, 1., 5e-3);
  expect([](const double s) { return 0.5 * (ellipse(s) + std::max(0., 1. - s * s)); }, 1., 5e-3);
  // sqrt(1 - s^2) (1 + 0.4 s) is largest where 0.8 s^2 + s - 0.4 = 0.
  const double s = (-1. + std::sqrt(1. + 1.28)) / 1.6;
  expect([](const double at) { return ellipse(at) * (1. + 0.4 * at); }, ellipse(s) * (1. + 0.4 * s), 5e-3);
}

TEST(PressureRecovery, SmoothsDents)
{
  const auto dented  = [](const double s) { return ellipse(s) * (1. + 0.15 * std::cos(9. * s)); };
  const auto samples = sampled([&](const double xi) { return dented((xi - 0.9) / 0.7); }, 2. * M_PI / 9. * 0.7);
  const auto result  = recover(samples);
  ASSERT_TRUE(result.is_fitted);
  EXPECT_NEAR(result.largest, 1., 0.05); // the samples' is 1.15
  bool falls = false;
  for (std::size_t i = 1; i < result.pressure.size(); ++i)
  {
    falls = falls || result.pressure[i] < result.pressure[i - 1];
    if (falls)
    {
      EXPECT_LE(result.pressure[i], result.pressure[i - 1]);
    }
  }
  for (const int power : { 0, 1 })
    EXPECT_NEAR(moment(samples, result.pressure, power) / moment(samples, samples.pressure, power), 1., 1e-12);
}

// Sliding friction leaves exponents of 0.39 and 0.61 for a layer without lateral contraction, which no candidate has; the cells
// at the edges have dents of a fifth.
TEST(PressureRecovery, HasNoFloor)
{
  const auto smooth = [](const double s)
  { return s * s < 1. ? std::pow(1. + s, 0.61) * std::pow(1. - s, 0.39) * std::exp(0.3 * s - 1.5 * std::pow(s, 4)) : 0.; };
  double largest = 0.;
  for (int i = -999; i < 1000; ++i)
    largest = std::max(largest, smooth(0.001 * i));
  double largest_tolerance = 0.08, profile_tolerance = 0.09;
  for (const double cell : { 0.5, 0.25, 0.125, 0.0625 })
  {
    const auto dented = [&](const double xi)
    {
      const double s      = (xi - 0.9) / 0.7;
      const double inside = 0.7 * (1. - std::abs(s));
      return smooth(s) * (1. + (inside < cell ? 0.2 * std::sin(2. * M_PI * inside / cell) : 0.));
    };
    const auto samples = sampled(dented, cell);
    const auto result  = recover(samples);
    ASSERT_TRUE(result.is_fitted);
    double misfit = 0., size = 0.;
    for (std::size_t i = 0; i < samples.xi.size(); ++i)
    {
      const double p = smooth((samples.xi[i] - 0.9) / 0.7);
      misfit += (result.pressure[i] - p) * (result.pressure[i] - p);
      size += p * p;
    }
    EXPECT_LT(std::abs(result.largest / largest - 1.), largest_tolerance) << "cells of " << cell;
    EXPECT_LT(std::sqrt(misfit / size), profile_tolerance) << "cells of " << cell;
    largest_tolerance /= 4.;
    profile_tolerance /= 2.;
  }
}

TEST(PressureRecovery, LeavesWhatIsNoSingleContactOfSmoothBodies)
{
  const auto block  = [](const double) { return 0.1; };
  const auto two    = [](const double xi) { return ellipse((xi + 1.5) / 0.4) + ellipse((xi - 1.5) / 0.4); };
  const auto narrow = [](const double xi) { return ellipse(xi / 0.05); };
  const auto open   = [](const double) { return 0.; };
  for (const std::function<double(double)> &pressure : std::vector<std::function<double(double)>>{ block, two, narrow, open })
  {
    const auto samples = sampled(pressure);
    const auto result  = recover(samples);
    EXPECT_FALSE(result.is_fitted);
    EXPECT_EQ(result.pressure, samples.pressure);
  }
}
