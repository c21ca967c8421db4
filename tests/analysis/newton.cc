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
    State trial          = model.begin_step(model.initial_state({}), { 1., x, 1. });
    trial.coordinates[0] = guess;
    const auto result    = solve_equilibrium(model, trial, false);
    return { result, trial.coordinates[0] };
  }
} // namespace

TEST(Newton, SolvesALinearEquilibriumAtOnce)
{
  ToyModel model;
  const auto [result, q] = solve(model, 5., 2.);
  EXPECT_TRUE(result.converged);
  EXPECT_EQ(result.iterations, 2u); // the second finds nothing to correct
  EXPECT_DOUBLE_EQ(q, 2.);
}

TEST(Newton, EndsAtRoundOff)
{
  ToyModel model;
  model.equation         = [](const double q, const double x) { return ToyModel::Value{ x - q * q * q, -3. * q * q }; };
  const auto [result, q] = solve(model, 1., 8.);
  EXPECT_TRUE(result.converged);
  // The last correction was below 1e-7 of the overlap, 1 here: its square is left.
  EXPECT_NEAR(q, 2., 1e-13);
}

// Newton's method for atan q = 0 runs away from any guess beyond 1.3917 unless its corrections are cut.
TEST(Newton, CutsCorrectionsThatOvershoot)
{
  ToyModel model;
  model.equation = [](const double q, double) { return ToyModel::Value{ -std::atan(q), -1. / (1. + q * q) }; };
  for (const double guess : { 1.5, 3., 20. })
  {
    const auto [result, q] = solve(model, guess, 0.);
    EXPECT_TRUE(result.converged);
    EXPECT_NEAR(q, 0., 1e-12);
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
