// SPDX-License-Identifier: GPL-3.0-only
#include "fe/body/finite_statics.h"

#include "base/errors.h"

#include <gtest/gtest.h>
#include <random>

using namespace sprag;

namespace
{
  constexpr unsigned int n     = 40;
  constexpr unsigned int width = 5;

  /// Symmetric, its diagonal as large as the sum beside it and more, with the signs given.
  std::vector<std::vector<double>> matrix(const std::vector<double> &signs)
  {
    std::mt19937 generator(1);
    std::uniform_real_distribution<double> uniform(-1., 1.);
    std::vector<std::vector<double>> result(n, std::vector<double>(n));
    for (unsigned int i = 0; i < n; ++i)
    {
      result[i][i] = signs[i] * (2. * width + 1.);
      for (unsigned int j = i + 1; j <= std::min(n - 1, i + width); ++j)
        result[i][j] = result[j][i] = uniform(generator);
    }
    return result;
  }
} // namespace

// Diagonally dominant: by Gershgorin's circles there are as many negative eigenvalues, and by Sylvester pivots, as negative
// signs.
TEST(BandFactors, SolveAndCountNegativePivots)
{
  std::vector<double> signs(n, 1.);
  signs[3] = signs[17] = signs[18] = -1.;
  const auto full                  = matrix(signs);
  BandFactors band(n, width);
  for (unsigned int i = 0; i < n; ++i)
    for (unsigned int j = i; j <= std::min(n - 1, i + width); ++j)
      band.entries()[band.position(i, j)] = full[i][j];
  EXPECT_EQ(band.factorise(), 3u);

  dealii::Vector<double> exact(n), solved(n);
  for (unsigned int i = 0; i < n; ++i)
    exact[i] = 1. + i;
  for (unsigned int i = 0; i < n; ++i)
    for (unsigned int j = 0; j < n; ++j)
      solved[i] += full[i][j] * exact[j];
  band.solve(solved);
  for (unsigned int i = 0; i < n; ++i)
    EXPECT_NEAR(solved[i], exact[i], 1e-12 * n);
}

TEST(BandFactors, RefuseASingularMatrix)
{
  BandFactors band(3, 1);
  EXPECT_THROW(band.factorise(), AnalysisError);
}
