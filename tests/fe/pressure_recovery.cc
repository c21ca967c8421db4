#include "fe/pressure_recovery.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

using namespace sprag;

namespace
{
  /// A face from -3 to 3 mm.
  PressureSamples sampled(const std::function<double(double)> &pressure)
  {
    PressureSamples result;
    constexpr unsigned int n = 240;
    result.begin             = -3.;
    result.end               = 3.;
    for (unsigned int i = 0; i < n; ++i)
    {
      result.xi.push_back(-3. + 6. * (i + 0.5) / n);
      result.weight.push_back(40. * 6. / n);
      result.pressure.push_back(std::max(0., pressure(result.xi.back())));
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

  // Largest pressure and width of a contact from 0.2 to 1.6 mm; the samples are 0.018 of its width apart.
  void expect(const std::function<double(double)> &of_s, const double largest, const double tolerance)
  {
    const auto samples = sampled([&](const double xi) { return of_s((xi - 0.9) / 0.7); });
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
  const auto samples = sampled([&](const double xi) { return dented((xi - 0.9) / 0.7); });
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
