// SPDX-License-Identifier: GPL-3.0-only
#include "fe/algebra/block_krylov.h"

#include "base/errors.h"

#include <cmath>
#include <gtest/gtest.h>

using namespace sprag;

namespace
{
  constexpr double mass = 2., spring = 3.;

  /// Chains of n masses on springs, each held at one end; eigenvalues 4 spring/mass sin^2((2 k - 1) pi/(2 (2 n + 1))).
  Pencil chains(const unsigned int n, const unsigned int number)
  {
    const auto deformed = [n](std::vector<double> forces)
    {
      for (std::size_t begin = 0; begin < forces.size(); begin += n)
      {
        double carried = 0., moved = 0.;
        for (std::size_t i = begin; i < begin + n; ++i)
          carried += forces[i];
        for (std::size_t i = begin; i < begin + n; ++i)
        {
          moved += carried / spring;
          carried -= forces[i];
          forces[i] = moved;
        }
      }
      return forces;
    };
    const auto inertia = [](std::vector<double> motions)
    {
      for (double &motion : motions)
        motion *= mass;
      return motions;
    };
    return { number * n, deformed, inertia };
  }

  double eigenvalue(const unsigned int n, const unsigned int k)
  {
    return 4. * spring / mass * std::pow(std::sin((2. * k - 1.) * M_PI / (2. * (2. * n + 1.))), 2);
  }

  double product(const std::vector<double> &a, const std::vector<double> &b)
  {
    double sum = 0.;
    for (std::size_t i = 0; i < a.size(); ++i)
      sum += mass * a[i] * b[i];
    return sum;
  }
} // namespace

TEST(BlockKrylov, FindsTheLowestVibrationsOfAChain)
{
  constexpr unsigned int n = 600;
  const auto pairs         = normal_modes(chains(n, 1), 20);
  ASSERT_EQ(pairs.size(), 20u);
  for (unsigned int k = 0; k < pairs.size(); ++k)
  {
    const double expected = eigenvalue(n, k + 1);
    EXPECT_NEAR(pairs[k].value, expected, 1e-10 * expected) << k;
    for (unsigned int i = 0; i < n; ++i)
    {
      const double shape = std::sin((2. * k + 1.) * (i + 1.) * M_PI / (2. * n + 1.)) * std::sqrt(4. / (mass * (2. * n + 1.)));
      EXPECT_NEAR(std::abs(pairs[k].vector[i]), std::abs(shape), 1e-9) << k << ' ' << i;
    }
    for (unsigned int j = 0; j <= k; ++j)
      EXPECT_NEAR(product(pairs[j].vector, pairs[k].vector), j == k ? 1. : 0., 1e-11);
  }
}

TEST(BlockKrylov, FindsBothOfEqualVibrations)
{
  constexpr unsigned int n = 300;
  const auto pairs         = normal_modes(chains(n, 2), 12);
  for (unsigned int k = 0; k < pairs.size(); ++k)
  {
    const double expected = eigenvalue(n, k / 2 + 1);
    EXPECT_NEAR(pairs[k].value, expected, 1e-10 * expected) << k;
  }
  EXPECT_NEAR(product(pairs[0].vector, pairs[1].vector), 0., 1e-11);
}

// The layer's shear beside a soft spring has such a spectrum. The space grows on after restarts, and the soft vibration stays
// in it.
TEST(BlockKrylov, FindsVibrationsThatLieCloseTogether)
{
  constexpr unsigned int n = 2000;
  const auto value         = [](const std::size_t i) { return i == 0 ? 1. : 3e6 * (1. + 2e-3 * static_cast<double>(i)); };
  const auto deformed      = [&](std::vector<double> forces)
  {
    for (std::size_t i = 0; i < forces.size(); ++i)
      forces[i] /= value(i % n);
    return forces;
  };
  const auto pairs = normal_modes({ n, deformed, [](const auto &motions) { return motions; } }, 24);
  for (unsigned int k = 0; k < pairs.size(); ++k)
  {
    EXPECT_NEAR(pairs[k].value, value(k), 1e-9 * value(k)) << k;
    EXPECT_NEAR(std::abs(pairs[k].vector[k]), 1., 1e-9) << k;
  }
}

TEST(BlockKrylov, SaysWhereNothingMoves)
{
  auto pencil              = chains(100, 1);
  pencil.inverse_stiffness = [](std::vector<double> forces) { return std::vector<double>(forces.size(), 0.); };
  EXPECT_THROW(normal_modes(pencil, 4), AnalysisError);
}
