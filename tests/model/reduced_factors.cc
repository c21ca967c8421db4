// SPDX-License-Identifier: GPL-3.0-only
#include "model/reduced_factors.h"
#include "model/port_forces.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace sprag;
using Vector = dealii::Vector<double>;
using Matrix = dealii::FullMatrix<double>;

namespace
{
  // Nodes of three ports, which yield by themselves and turn with a hub, the last port.
  constexpr unsigned int n_nodes = 60, n = 3 * n_nodes + 1, hub = n - 1;
  constexpr double arm = 150.; // [mm]

  PortCompliance compliance()
  {
    constexpr double of_hub = 1e-5; // [1/(N mm)]
    Matrix result(n);
    result(hub, hub) = of_hub;
    for (unsigned int a = 0; a < n_nodes; ++a)
    {
      result(hub, 3 * a + 1) = result(3 * a + 1, hub) = arm * of_hub;
      for (unsigned int b = 0; b < n_nodes; ++b)
      {
        for (unsigned int d = 0; d < 3; ++d)
          result(3 * a + d, 3 * b + d) = 2e-3 * std::exp(-0.2 * std::abs(static_cast<double>(a) - static_cast<double>(b)));
        result(3 * a + 1, 3 * b + 1) += arm * arm * of_hub;
      }
    }
    PortCompliance blocks;
    blocks.append(result);
    return blocks;
  }

  /// Friction that follows the pressure, and a share of what it would yield by in stick.
  Matrix tangent(const double share_of_stick)
  {
    constexpr double stiffness = 300., mu = 0.6;
    Matrix result(n);
    for (unsigned int a = 0; a < n_nodes; ++a)
      for (unsigned int b = a == 0 ? 0 : a - 1; b < std::min(a + 2, n_nodes); ++b)
      {
        const double springs = stiffness * (a == b ? 1. : 0.25);
        result(3 * a, 3 * b + 1) -= mu * springs;
        result(3 * a + 1, 3 * b + 1) -= springs;
        result(3 * a, 3 * b) -= share_of_stick * springs;
        result(3 * a + 2, 3 * b + 2) -= share_of_stick * springs;
        // The cylinder's axis does not turn with the hub.
        result(hub, 3 * b) += 40. * mu * springs;
      }
    return result;
  }

  Vector some_displacements()
  {
    Vector result(n);
    for (unsigned int i = 0; i < n; ++i)
      result[i] = std::sin(1.7 * i);
    return result;
  }

  /// r - (1 - A G) f.
  Vector rest_of(const Matrix &tangent, const Vector &r, const Vector &forces)
  {
    Vector displacements(n), result = r;
    add_response(compliance(), all_ports(n), forces, all_ports(n), displacements);
    result -= forces;
    tangent.vmult_add(result, displacements);
    return result;
  }
} // namespace

TEST(ReducedFactors, FindWhatFollowsInSlidingAndInStick)
{
  for (const double share : { 0., 1e-3, 0.02, 1. })
  {
    const auto of_contact = tangent(share);
    const ReducedFactors factors(compliance(), all_ports(n), of_contact);
    const auto z = some_displacements();
    Vector r(n), of_factors(n), forces(n);
    of_contact.vmult(r, z);
    factors.add_forces(z, of_factors);
    of_factors -= r;
    EXPECT_LT(of_factors.linfty_norm(), 1e-12 * r.linfty_norm()) << share;
    factors.add_solution(r, 1e-3, forces);
    EXPECT_LT(factors.size(rest_of(of_contact, r, forces)), 5e-3 * factors.size(r)) << share;
  }
}

// Forces that move little count as little, whatever their units.
TEST(ReducedFactors, ForcesAreMeasuredByWhatTheyMove)
{
  const ReducedFactors factors(compliance(), all_ports(n), tangent(0.));
  Vector moment(n), force(n);
  moment[hub] = 1.;
  force[0]    = 1.;
  EXPECT_NEAR(factors.size(moment), std::sqrt(1e-5), 1e-12);
  EXPECT_NEAR(factors.size(force), std::sqrt(2e-3), 1e-12);
}

// What they leave unbalanced moves nothing: a share of the forces as small would not do.
TEST(ReducedFactors, ReactionsOfManyPortsAreExact)
{
  for (const double share : { 0., 1e-3, 0.02, 1. })
  {
    const auto of_contact = tangent(share);
    const auto z          = some_displacements();
    Vector r(n);
    of_contact.vmult(r, z);
    const auto forces = port_reaction(compliance(), all_ports(n), of_contact, z);
    Vector moved(n);
    add_response(compliance(), all_ports(n), rest_of(of_contact, r, forces), all_ports(n), moved);
    const ReducedFactors measure(compliance(), all_ports(n), of_contact);
    EXPECT_LT(measure.movement(moved), 1.1e-10 * measure.movement(z)) << share;
  }
}

TEST(ReducedFactors, NothingFollowsWithoutContact)
{
  const ReducedFactors factors(compliance(), all_ports(n), Matrix(n));
  const auto r = some_displacements();
  Vector forces(n);
  factors.add_solution(r, 1e-3, forces);
  forces -= r;
  EXPECT_LT(factors.size(forces), 1e-6 * factors.size(r));
}
