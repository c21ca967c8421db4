// SPDX-License-Identifier: GPL-3.0-only
#include "base/nonlinear_least_squares.h"

#include <cmath>
#include <gtest/gtest.h>

using namespace sprag;

namespace
{
  /// NIST's Misra1a: y = b1 (1 - exp(-b2 x)), unknowns over the certified values.
  std::vector<double> misra(const std::vector<double> &scaled)
  {
    const std::vector<double> x = {
      77.6, 114.9, 141.1, 190.8, 239.9, 289., 332.8, 378.4, 434.8, 477.3, 536.8, 593.1, 689.1, 760.
    };
    const std::vector<double> y = { 10.07, 14.73, 17.94, 23.93, 29.61, 35.18, 40.02,
                                    44.82, 50.76, 55.05, 61.01, 66.4,  75.47, 81.78 };
    std::vector<double> result;
    for (std::size_t i = 0; i < x.size(); ++i)
      result.push_back(y[i] - 238.94212918 * scaled[0] * (1. - std::exp(-5.5015643181e-4 * scaled[1] * x[i])));
    return result;
  }
} // namespace

TEST(NonlinearLeastSquares, FindsTheCertifiedValuesOfMisra)
{
  const auto found = least_squares(misra, { 500. / 238.94212918, 1e-4 / 5.5015643181e-4 });
  EXPECT_NEAR(found[0], 1., 1e-7);
  EXPECT_NEAR(found[1], 1., 1e-7);
  double squares = 0.;
  for (const double residual : misra(found))
    squares += residual * residual;
  EXPECT_NEAR(squares, 0.12455138894, 1e-9);
}

TEST(NonlinearLeastSquares, StandardDeviationsFollowFromTheJacobian)
{
  // Certified: 2.7070075241 and 7.2668688436e-6 with a residual standard deviation of 0.10187876330.
  const auto slopes   = jacobian(misra, { 1., 1. });
  const auto singular = singular_values(slopes, 2);
  for (std::size_t i = 0; i < 2; ++i)
  {
    double variance = 0.;
    for (std::size_t j = 0; j < 2; ++j)
      variance += std::pow(singular.directions[2 * i + j] / singular.values[j], 2);
    const double certified = i == 0 ? 2.7070075241 / 238.94212918 : 7.2668688436e-6 / 5.5015643181e-4;
    EXPECT_NEAR(0.10187876330 * std::sqrt(variance), certified, 1e-6 * certified);
  }
}

TEST(NonlinearLeastSquares, SingularValuesOfAColumnOfZerosIsZero)
{
  const auto singular = singular_values({ 3., 0., 4., 0., 0., 0. }, 2);
  EXPECT_NEAR(singular.values[0], 5., 1e-14);
  EXPECT_EQ(singular.values[1], 0.);
  EXPECT_NEAR(std::abs(singular.directions[3]), 1., 1e-14);
}
