// SPDX-License-Identifier: GPL-3.0-only
#include "model/step/modified_newton.h"

#include <cmath>
#include <gtest/gtest.h>

using namespace sprag;
using Vector = dealii::Vector<double>;

namespace
{
  constexpr unsigned int n = 40;

  /// A row of dofs, which feel each other the less the further they are apart, and one of a block of its own.
  InterfaceCompliance interface_chain()
  {
    dealii::FullMatrix<double> matrix(n);
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = 0; j < n; ++j)
        matrix(i, j) = std::exp(-0.3 * std::abs(static_cast<double>(i) - j));
    InterfaceCompliance result;
    result.append(std::move(matrix));
    result.append(0.5);
    return result;
  }

  /// Springs that a ball touches from above at some place of the row, and rubs: only dofs that touch carry forces.
  struct Ball
  {
    double place;
    double stiffness         = 5.;
    double mu                = 0.3;
    unsigned int evaluations = 0, tangents = 0;
    double deepest         = 0.;
    InterfaceForces forces = InterfaceForces();

    InterfaceEvaluation operator()(const Vector &z, const Request request = Request::with_tangent)
    {
      const bool with_tangent = request != Request::forces;
      ++evaluations;
      tangents += with_tangent ? 1 : 0;
      forces  = InterfaceForces();
      deepest = 0.;
      for (unsigned int i = 0; i < n; ++i)
        if (penetration(z, i) > 0.)
          forces.dofs.push_back(i);
      if (!forces.dofs.empty())
        forces.dofs.push_back(n);
      const auto m = static_cast<unsigned int>(forces.dofs.size());
      forces.values.reinit(m);
      if (with_tangent)
        forces.tangent.reinit(m, m);
      for (unsigned int a = 0; a + 1 < m; ++a)
      {
        const double depth = penetration(z, forces.dofs[a]);
        deepest            = std::max(deepest, depth);
        forces.values[a]   = -stiffness * depth * (1. + 0.1 * std::sin(z[n]));
        forces.values[m - 1] += mu * stiffness * depth;
        if (!with_tangent)
          continue;
        forces.tangent(a, a)     = -stiffness * (1. + 0.1 * std::sin(z[n]));
        forces.tangent(a, m - 1) = -stiffness * depth * 0.1 * std::cos(z[n]);
        forces.tangent(m - 1, a) = mu * stiffness;
      }
      return { &forces, deepest };
    }

    double penetration(const Vector &z, const unsigned int i) const
    {
      const double aside = i - place;
      return z[i] - 0.01 * aside * aside;
    }
  };

  struct Solved
  {
    InterfaceSolution solution;
    Vector z;
    Ball ball;
  };

  const InterfaceCompliance compliance = interface_chain();
  const Vector lengths                 = []
  {
    Vector result(n + 1);
    result    = 1.;
    result[n] = 3.;
    return result;
  }();
  const DofSelection selected = all_dofs(n + 1);

  Vector pressed_by(const double amount)
  {
    Vector result(n + 1);
    result    = amount;
    result[n] = 0.1;
    return result;
  }

  Solved by_newton(const double place, const double amount)
  {
    Solved result{ {}, pressed_by(amount), { place } };
    const Vector free = result.z;
    result.solution   = solve_interface(
          { compliance, free, lengths, selected }, [&](const Vector &z) { return result.ball(z); }, result.z);
    return result;
  }

  DofLoads solved_loads(const Solved &solved)
  {
    return { solved.ball.forces.dofs, solved.ball.forces.values };
  }

  Solved by_stored_jacobian(const double place, const double amount, const DofLoads &guess, JacobianFactors &factors,
                            std::shared_ptr<const StoredJacobian> &kept)
  {
    Solved result{ {}, pressed_by(amount), { place } };
    const Vector free = result.z;
    const InterfaceEquations equations{ compliance, free, lengths, selected };
    const auto weights = generalised_alpha(0.8, 1e-3);
    auto &ball         = result.ball;
    const auto forces  = [&](const Vector &z, const Request request) { return ball(z, request); };
    result.solution    = ModifiedNewton(equations, forces, weights, factors).solve(guess, kept, result.z, 0.1);
    return result;
  }
} // namespace

// The remaining residual moves no point by more than 1e-8 of the penetration; a few times as much is allowed.
TEST(ModifiedNewton, FindsWhatNewtonsMethodFinds)
{
  JacobianFactors factors;
  std::shared_ptr<const StoredJacobian> kept;
  auto guess            = solved_loads(by_newton(12., 0.5));
  unsigned int tangents = 0, abandoned = 0;
  for (unsigned int step = 0; step < 12; ++step)
  {
    const double place = 12. + 0.05 * step, amount = 0.5 + 0.005 * step;
    const auto expected = by_newton(place, amount);
    ASSERT_TRUE(expected.solution.newton.converged);
    ASSERT_GT(expected.ball.deepest, 0.);
    const auto found = by_stored_jacobian(place, amount, guess, factors, kept);
    if (!found.solution.newton.converged) // as between springs that touch and let go by turns
    {
      ++abandoned;
      kept  = nullptr;
      guess = solved_loads(expected);
      continue;
    }
    EXPECT_EQ(found.ball.forces.dofs, expected.ball.forces.dofs);
    for (unsigned int i = 0; i <= n; ++i)
      EXPECT_NEAR(found.z[i], expected.z[i], 5e-8 * expected.ball.deepest) << "step " << step << ", dof " << i;
    guess = solved_loads(found);
    tangents += found.ball.tangents;
    ASSERT_NE(kept, nullptr);
  }
  EXPECT_LE(abandoned, 2u);
  EXPECT_LT(tangents, 36u); // else nothing is kept
}

TEST(ModifiedNewton, SaysWhereItDoesNotConverge)
{
  JacobianFactors factors;
  const auto wrong = std::make_shared<const StoredJacobian>(StoredJacobian{ { 3 }, dealii::FullMatrix<double>(1) });
  auto kept        = wrong;
  // Springs that pull: no correction makes the unbalance fall.
  Solved result{ {}, pressed_by(0.5), { 12., -30. } };
  const Vector free = result.z;
  const InterfaceEquations equations{ compliance, free, lengths, selected };
  const auto forces = [&](const Vector &z, const Request request) { return result.ball(z, request); };
  const auto found  = ModifiedNewton(equations, forces, generalised_alpha(0.8, 1e-3), factors).solve({}, kept, result.z, 0.1);
  EXPECT_FALSE(found.newton.converged);
}
