// SPDX-License-Identifier: GPL-3.0-only
#include "model/structure/eigenvalues.h"

#include "base/errors.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>

using namespace sprag;

namespace
{
  using Complex = std::complex<double>;
  using Full    = dealii::FullMatrix<double>;

  Full matrix(const unsigned int n, const std::vector<double> &rows)
  {
    Full result(n, n);
    result.fill(rows.data());
    return result;
  }

  /// |A v - lambda v| over |v|.
  double residual(const Full &matrix, const Eigenpair &pair)
  {
    double sum  = 0.;
    double size = 0.;
    for (unsigned int i = 0; i < matrix.m(); ++i)
    {
      Complex left;
      for (unsigned int j = 0; j < matrix.n(); ++j)
        left += matrix(i, j) * Complex(pair.vector[0][j], pair.vector[1][j]);
      const Complex v(pair.vector[0][i], pair.vector[1][i]);
      sum += std::norm(left - pair.value * v);
      size += std::norm(v);
    }
    return std::sqrt(sum / size);
  }
} // namespace

// The companion matrix of (x - 2) (x^2 + 2x + 10): 2, -1 +- 3i.
TEST(Eigenpairs, AreTheRootsOfTheCharacteristicPolynomial)
{
  const Full companion = matrix(3, { 0., -6., 20., 1., 0., 0., 0., 1., 0. });
  auto pairs           = eigenpairs(companion);
  ASSERT_EQ(pairs.size(), 2u);
  std::sort(pairs.begin(), pairs.end(), [](const auto &a, const auto &b) { return a.value.real() < b.value.real(); });
  EXPECT_LT(std::abs(pairs[0].value - Complex(-1., 3.)), 1e-13);
  EXPECT_LT(std::abs(pairs[1].value - 2.), 1e-13);
  EXPECT_EQ(pairs[1].value.imag(), 0.);
  EXPECT_EQ(pairs[1].vector[1].linfty_norm(), 0.);
  for (const auto &pair : pairs)
    EXPECT_LT(residual(companion, pair), 1e-13);
}

// A transposed matrix has the same eigenvalues and other right vectors.
TEST(Eigenpairs, VectorsAreRightOnes)
{
  const Full shear = matrix(2, { 1., 5., 0., 2. });
  for (const auto &pair : eigenpairs(shear))
    EXPECT_LT(residual(shear, pair), 1e-14);
}

TEST(Eigenpairs, OfACyclicShiftAreTheRootsOfUnity)
{
  constexpr unsigned int n = 12;
  Full shift(n, n);
  for (unsigned int i = 0; i < n; ++i)
    shift(i, (i + 1) % n) = 1.;
  const auto pairs = eigenpairs(shift);
  EXPECT_EQ(pairs.size(), n / 2 + 1);
  for (const auto &pair : pairs)
  {
    EXPECT_GE(pair.value.imag(), 0.);
    EXPECT_LT(std::abs(std::pow(pair.value, 12) - 1.), 1e-13);
    EXPECT_LT(residual(shift, pair), 1e-14);
  }
}

TEST(Eigenpairs, OfNoNumbersAreAnError)
{
  Full broken(3, 3);
  broken(1, 2) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(eigenpairs(broken), AnalysisError);
}
