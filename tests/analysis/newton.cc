// SPDX-License-Identifier: GPL-3.0-only
#include "analysis/statics/quasi_static.h"

#include "analysis/toy_model.h"

#include <gtest/gtest.h>

using namespace sprag;

namespace
{
  struct Solution
  {
    NewtonResult result;
    double q;
  };

  Solution solve(ToyModel &model, const double guess, const double x)
  {
    Step step                 = model.begin_step(model.initial_state({}), { 1., x, 1. });
    step.trial.coordinates[0] = guess;
    const auto result         = solve_equilibrium(model, step, false);
    return { result, step.trial.coordinates[0] };
  }
} // namespace

// Newton's method for atan q = 0 runs away from any guess beyond 1.3917 unless its corrections are cut.
TEST(Newton, CutsCorrectionsThatOvershoot)
{
  ToyModel model;
  model.equation = [](const double q, double) { return ToyModel::Value{ -std::atan(q), -1. / (1. + q * q) }; };
  for (const double guess : { 1.5, 3., 20. })
  {
    const auto [result, q] = solve(model, guess, 0.);
    EXPECT_TRUE(result.converged);
    EXPECT_NEAR(q, 0., 1e-9);
  }
}

TEST(Newton, SaysSoWhereThereIsNoEquilibrium)
{
  ToyModel model;
  model.equation         = [](const double q, double) { return ToyModel::Value{ 1. + q * q, 2. * q }; };
  const auto [result, q] = solve(model, 3., 0.);
  EXPECT_FALSE(result.converged);
  EXPECT_GT(result.iterations, 1u);
}

// q^3 = 8 from 3: errors 1, 0.30, 0.04, 7e-4, 3e-7, 3e-14. The correction by 3e-7 is beyond the tolerance, and what it leaves is
// not worth another one.
TEST(Newton, LeavesOutALastCorrection)
{
  const auto solve_cube = [](const double left_out)
  {
    dealii::Vector<double> q(1);
    q[0] = 3.;
    struct Cube
    {
      double residual;
      double penetration;
    };
    const auto evaluate   = [](const dealii::Vector<double> &at) { return Cube{ std::abs(8. - at[0] * at[0] * at[0]), 1. }; };
    const auto correction = [&q](const Cube &)
    {
      dealii::Vector<double> change(1);
      change[0] = (8. - q[0] * q[0] * q[0]) / (3. * q[0] * q[0]);
      return change;
    };
    const auto movement = [](const dealii::Vector<double> &change) { return std::abs(change[0]); };
    const auto result   = solve_by_newton(q, 1e-14, evaluate, correction, movement, left_out);
    EXPECT_TRUE(result.converged);
    EXPECT_NEAR(q[0], 2., left_out == 0. ? 1e-14 : 1e-8);
    return result.iterations;
  };
  EXPECT_EQ(solve_cube(0.), 6u);
  EXPECT_EQ(solve_cube(0.1), 5u);
}
