// SPDX-License-Identifier: GPL-3.0-only
#include "model/port_forces.h"

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

  /// Two alike blocks, by default of four ports, and one of a single port.
  PortCompliance two_lever_compliance(const unsigned int ports = 4)
  {
    PortCompliance result;
    const auto lever = std::make_shared<const Matrix>(symmetric(ports));
    result.append(lever);
    result.append(lever);
    result.append(0.7);
    return result;
  }

  const PortSelection all = all_ports(9);

  /// On ports of both levers and the support, each lever's by its own displacements and, if coupled, by those of the last port of
  /// each lever and the support.
  PortForces forces(const bool coupled, const unsigned int ports = 4)
  {
    PortForces result;
    for (unsigned int port = 0; port <= 2 * ports; ++port)
      if (port != 2 && port != ports && port != ports + 2)
        result.ports.push_back(port);
    const auto n = static_cast<unsigned int>(result.ports.size());
    result.values.reinit(n);
    result.tangent.reinit(n, n);
    const auto lever     = [&](const unsigned int a) { return result.ports[a] / ports; };
    const auto is_common = [&](const unsigned int a)
    { return result.ports[a] % ports == ports - 1 || result.ports[a] == 2 * ports; };
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

TEST(PortForces, PortsOfDifferentBlocksFeelNothingOfEachOther)
{
  const auto compliance = two_lever_compliance();
  ASSERT_EQ(compliance.size(), 9u);
  const auto f = forces(true);
  Vector z(9);
  add_response(compliance, f.ports, f.values, all, z);
  for (unsigned int i = 0; i < 9; ++i)
  {
    double expected = 0.;
    for (unsigned int a = 0; a < f.ports.size(); ++a)
      expected += compliance(i, f.ports[a]) * f.values[a];
    EXPECT_NEAR(z[i], expected, 1e-15) << i;
  }
  EXPECT_EQ(compliance(0, 4), 0.);
  EXPECT_EQ(compliance(1, 2), compliance(5, 6));
}

// dz = mismatch + G (df/dz) dz, whatever the levers feel of each other through the forces, of few ports and of more.
TEST(PortForces, CorrectionSolvesTheLinearisedEquations)
{
  for (const unsigned int ports : { 4u, 160u })
    for (const bool coupled : { false, true })
    {
      const auto compliance = two_lever_compliance(ports);
      const auto everywhere = all_ports(compliance.size());
      const auto f          = forces(coupled, ports);
      Vector mismatch(compliance.size());
      for (auto &value : mismatch)
        value = any();
      const auto change = port_correction(compliance, f.ports, f.tangent, everywhere, mismatch);
      Vector force_changes(f.values.size()), at_forces(f.values.size());
      for (unsigned int a = 0; a < f.ports.size(); ++a)
        at_forces[a] = change[f.ports[a]];
      f.tangent.vmult(force_changes, at_forces);
      Vector expected = mismatch;
      add_response(compliance, f.ports, force_changes, everywhere, expected);
      expected -= change;
      EXPECT_LE(expected.linfty_norm(), 1e-11 * change.linfty_norm()) << ports << ' ' << coupled;
    }
}

TEST(PortForces, DeterminantIsThatOfTheWholeMatrix)
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
          whole(a, b) -= compliance(f.ports[a], f.ports[c]) * f.tangent(c, b);
      }
    // By elimination.
    double expected = 1.;
    for (unsigned int k = 0; k < 6; ++k)
    {
      expected *= whole(k, k);
      for (unsigned int i = k + 1; i < 6; ++i)
        for (unsigned int j = 6; j-- > k;)
          whole(i, j) -= whole(i, k) / whole(k, k) * whole(k, j);
    }
    EXPECT_NEAR(port_determinant(compliance, f.ports, f.tangent), expected, 1e-11 * std::abs(expected)) << coupled;
  }
}

TEST(PortForces, CorrectionOfASingleBlockSolvesTheLinearisedEquations)
{
  for (const unsigned int n : { 5u, 12u, 20u })
  {
    PortCompliance compliance;
    compliance.append(symmetric(n));
    const auto everywhere = all_ports(n);
    Matrix tangent(n);
    Vector mismatch(n), force_changes(n);
    for (unsigned int i = 0; i < n; ++i)
    {
      mismatch[i] = any();
      for (unsigned int j = 0; j < n; ++j)
        tangent(i, j) = any();
    }
    const auto change = port_correction(compliance, everywhere, tangent, everywhere, mismatch);
    tangent.vmult(force_changes, change);
    Vector expected = mismatch;
    add_response(compliance, everywhere, force_changes, everywhere, expected);
    expected -= change;
    EXPECT_LE(expected.linfty_norm(), 1e-11 * change.linfty_norm()) << n;
  }
}
