// SPDX-License-Identifier: GPL-3.0-only
#include "model/interface/interface_forces.h"
#include "model/interface/interface_factors.h"

#include <gtest/gtest.h>

#include <random>

using namespace sprag;
using Vector = dealii::Vector<double>;
using Matrix = dealii::FullMatrix<double>;

namespace
{
  std::mt19937 generator(7);

  double any()
  {
    return std::uniform_real_distribution<double>(-1., 1.)(generator);
  }

  Matrix symmetric(const unsigned int n)
  {
    Matrix result(n);
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = 0; j <= i; ++j)
        result(i, j) = result(j, i) = any();
    return result;
  }

  /// Two alike blocks, by default of four dofs, and one of a single dof.
  InterfaceCompliance two_lever_compliance(const unsigned int lever_dofs = 4)
  {
    InterfaceCompliance result;
    const auto lever = std::make_shared<const Matrix>(symmetric(lever_dofs));
    result.append(lever);
    result.append(lever);
    result.append(0.7);
    return result;
  }

  const DofSelection all = all_dofs(9);

  /// Forces on dofs of both levers and the support, each lever's by its own displacements and, if coupled, by those of the last
  /// dof of each lever and the support.
  InterfaceForces forces(const bool coupled, const unsigned int lever_dofs = 4)
  {
    InterfaceForces result;
    for (unsigned int dof = 0; dof <= 2 * lever_dofs; ++dof)
      if (dof != 2 && dof != lever_dofs && dof != lever_dofs + 2)
        result.dofs.push_back(dof);
    const auto n = static_cast<unsigned int>(result.dofs.size());
    result.values.reinit(n);
    result.tangent.reinit(n, n);
    const auto lever     = [&](const unsigned int a) { return result.dofs[a] / lever_dofs; };
    const auto is_common = [&](const unsigned int a)
    { return result.dofs[a] % lever_dofs == lever_dofs - 1 || result.dofs[a] == 2 * lever_dofs; };
    for (unsigned int a = 0; a < n; ++a)
    {
      result.values[a] = any();
      for (unsigned int b = 0; b < n; ++b)
        if (lever(a) == lever(b) || (coupled && is_common(b)))
          result.tangent(a, b) = any();
    }
    return result;
  }
} // namespace

TEST(InterfaceForces, DofsOfDifferentBlocksFeelNothingOfEachOther)
{
  const auto compliance = two_lever_compliance();
  ASSERT_EQ(compliance.size(), 9u);
  const auto f = forces(true);
  Vector z(9);
  add_response(compliance, f.dofs, f.values, all, z);
  for (unsigned int i = 0; i < 9; ++i)
  {
    double expected = 0.;
    for (unsigned int a = 0; a < f.dofs.size(); ++a)
      expected += compliance(i, f.dofs[a]) * f.values[a];
    EXPECT_NEAR(z[i], expected, 1e-15) << i;
  }
  EXPECT_EQ(compliance(0, 4), 0.);
  EXPECT_EQ(compliance(1, 2), compliance(5, 6));
}

// dz = mismatch + G (df/dz) dz, whatever the levers feel of each other through the forces, of few dofs and of more.
TEST(InterfaceForces, CorrectionSolvesTheLinearisedEquations)
{
  for (const unsigned int lever_dofs : { 4u, 160u })
    for (const bool coupled : { false, true })
    {
      const auto compliance = two_lever_compliance(lever_dofs);
      const auto everywhere = all_dofs(compliance.size());
      const auto f          = forces(coupled, lever_dofs);
      Vector mismatch(compliance.size());
      for (auto &value : mismatch)
        value = any();
      const auto change = interface_correction(compliance, f.dofs, f.tangent, everywhere, mismatch);
      Vector force_changes(f.values.size()), at_forces(f.values.size());
      for (unsigned int a = 0; a < f.dofs.size(); ++a)
        at_forces[a] = change[f.dofs[a]];
      f.tangent.vmult(force_changes, at_forces);
      Vector expected = mismatch;
      add_response(compliance, f.dofs, force_changes, everywhere, expected);
      expected -= change;
      EXPECT_LE(expected.linfty_norm(), 1e-11 * change.linfty_norm()) << lever_dofs << ' ' << coupled;
    }
}

TEST(InterfaceForces, DeterminantIsThatOfTheWholeMatrix)
{
  const auto compliance = two_lever_compliance();
  for (const bool coupled : { false, true })
  {
    const auto f = forces(coupled);
    Matrix whole(6);
    for (unsigned int a = 0; a < 6; ++a)
      for (unsigned int b = 0; b < 6; ++b)
      {
        whole(a, b) = a == b ? 1. : 0.;
        for (unsigned int c = 0; c < 6; ++c)
          whole(a, b) -= compliance(f.dofs[a], f.dofs[c]) * f.tangent(c, b);
      }
    // The expected value comes from elimination.
    double expected = 1.;
    for (unsigned int k = 0; k < 6; ++k)
    {
      expected *= whole(k, k);
      for (unsigned int i = k + 1; i < 6; ++i)
        for (unsigned int j = 6; j-- > k;)
          whole(i, j) -= whole(i, k) / whole(k, k) * whole(k, j);
    }
    EXPECT_NEAR(InterfaceFactors(compliance, f.dofs, f.tangent).determinant(), expected, 1e-11 * std::abs(expected)) << coupled;
  }
}
