// SPDX-License-Identifier: GPL-3.0-only
#include "model/structure/modal_vibration.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <random>

using namespace sprag;

namespace
{
  using Complex = std::complex<double>;

  /// Two modes of mass 1 with one dof each.
  ModalData two_modes(const double first, const double second)
  {
    ModalData data;
    data.layout    = { 2, false };
    data.stiffness = { first, second };
    data.damping.reinit(2, 2);
    data.shapes.reinit(3, 2);
    data.shapes(0, 0) = 1.;
    data.shapes(1, 1) = 1.;
    return data;
  }

  LinearisedForces no_forces(const DofSelection &dofs)
  {
    LinearisedForces forces;
    forces.dofs  = dofs;
    const auto n = static_cast<unsigned int>(dofs.size());
    for (auto *const matrix :
         { &forces.pressure, &forces.friction, &forces.pressure_rate, &forces.friction_rate, &forces.inertia })
      matrix->reinit(n, n);
    return forces;
  }

  void expect_near(const Complex found, const Complex expected, const double tolerance)
  {
    EXPECT_LE(std::abs(found - expected), tolerance) << found << " " << expected;
  }

  std::vector<Complex> eigenvalues(const ModalData &data, const LinearisedForces &forces)
  {
    std::vector<Complex> result;
    for (const auto &mode : modal_vibrations(data, forces))
    {
      EXPECT_LT(mode.residual, 1e-12);
      EXPECT_GE(mode.eigenvalue.imag(), 0.);
      result.push_back(mode.eigenvalue);
    }
    const auto alone = modal_vibrations(data, forces, false);
    EXPECT_EQ(alone.size(), result.size());
    for (std::size_t i = 0; i < std::min(alone.size(), result.size()); ++i)
      expect_near(alone[i].eigenvalue, result[i], 1e-10 * std::abs(result[i]));
    return result;
  }

  /// Returns det(1 - G(lambda) A) of the interface displacements, in complex arithmetic: 0 at an eigenvalue.
  Complex interface_determinant_at(const ModalData &data, const LinearisedForces &forces, const Complex lambda)
  {
    const auto n = static_cast<unsigned int>(forces.dofs.size());
    std::vector<std::vector<Complex>> m(n, std::vector<Complex>(n));
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = 0; j < n; ++j)
      {
        m[i][j] = i == j ? 1. : 0.;
        for (unsigned int k = 0; k < n; ++k)
        {
          const unsigned int a = forces.dofs[i];
          const unsigned int b = forces.dofs[k];
          Complex compliance;
          for (unsigned int q = 0; q < data.stiffness.size(); ++q)
            compliance +=
                data.shapes(a, q) * data.shapes(b, q) / (data.stiffness[q] + lambda * data.damping(q, q) + lambda * lambda);
          if (a < data.face_compliance.m() && b < data.face_compliance.m())
            compliance += data.face_compliance(a, b) / (1. + lambda * data.relaxation);
          const Complex force = forces.pressure(k, j) + forces.friction(k, j) +
                                lambda * (forces.pressure_rate(k, j) + forces.friction_rate(k, j)) -
                                lambda * lambda * forces.inertia(k, j);
          m[i][j] -= compliance * force;
        }
      }
    Complex result = 1.;
    for (unsigned int i = 0; i < n; ++i)
    {
      result *= m[i][i];
      for (unsigned int k = i + 1; k < n; ++k)
      {
        const Complex factor = m[k][i] / m[i][i];
        for (unsigned int j = i; j < n; ++j)
          m[k][j] -= factor * m[i][j];
      }
    }
    return result;
  }

  /// A root of the determinant near `from`, by the secant method.
  Complex root_near(const ModalData &data, const LinearisedForces &forces, const Complex from)
  {
    Complex a   = from * 1.0001;
    Complex b   = from * Complex(1., 1e-4);
    Complex f_a = interface_determinant_at(data, forces, a);
    for (unsigned int i = 0; i < 50; ++i)
    {
      const Complex f_b = interface_determinant_at(data, forces, b);
      if (f_b == f_a || std::abs(b - a) < 1e-15 * std::abs(b))
        break;
      const Complex next = b - f_b * (b - a) / (f_b - f_a);
      a                  = b;
      f_a                = f_b;
      b                  = next;
    }
    return b;
  }
} // namespace

TEST(ModalVibration, OfADampedOscillatorIsThatOfTheFormula)
{
  auto data          = two_modes(4., 900.);
  data.damping(0, 0) = 0.4;
  data.damping(1, 1) = 100.;
  const auto found   = eigenvalues(data, no_forces({}));
  // lambda = -c/2 +- sqrt(c^2/4 - omega^2): a pair, and two that do not vibrate.
  ASSERT_EQ(found.size(), 3u);
  expect_near(found[0], { -0.2, std::sqrt(4. - 0.04) }, 1e-13);
  expect_near(found[1], -50. + std::sqrt(1600.), 1e-12);
  expect_near(found[2], -50. - std::sqrt(1600.), 1e-12);
}

// Static shapes with relaxation, forces by displacements, rates and accelerations, all unsymmetric: against roots of the
// determinant at the interface alone, where neither modes nor states appear.
TEST(ModalVibration, FulfilsTheEquationOfTheInterface)
{
  std::mt19937 generator(1);
  std::uniform_real_distribution<double> uniform(-1., 1.);
  for (const double relaxation : { 0., 0.01 })
  {
    ModalData data;
    data.layout     = { 2, true };
    data.stiffness  = { 3., 20., 70. };
    data.relaxation = relaxation;
    data.damping.reinit(3, 3);
    data.shapes.reinit(6, 3);
    data.face_compliance.reinit(3, 3);
    for (unsigned int i = 0; i < 3; ++i)
    {
      data.damping(i, i)         = 0.1 * (1. + i);
      data.face_compliance(i, i) = 0.02;
      for (unsigned int dof = 0; dof < 6; ++dof)
        data.shapes(dof, i) = uniform(generator);
    }
    auto forces = no_forces({ 0, 1, 2, 5 });
    for (unsigned int i = 0; i < 4; ++i)
      for (unsigned int j = 0; j < 4; ++j)
      {
        forces.pressure(i, j)      = uniform(generator) - (i == j ? 5. : 0.);
        forces.friction(i, j)      = uniform(generator);
        forces.pressure_rate(i, j) = i == j ? -0.05 : 0.;
        forces.friction_rate(i, j) = 0.02 * uniform(generator);
        // The static shapes have no mass: no inertia on their dofs.
        forces.inertia(i, j) = i == 3 && j == 3 ? 0.3 : 0.;
      }
    unsigned int roots = 0;
    for (const Complex found : eigenvalues(data, forces))
    {
      expect_near(found, root_near(data, forces, found), 1e-10 * std::abs(found));
      roots += found.imag() > 0. ? 2 : 1;
    }
    // Two a mode, and one a static shape.
    EXPECT_EQ(roots, 9u);
  }
}

// Two of three static shapes bear no force: they creep back at -1 / relaxation, where their elastic force is 0 / 0.
TEST(ModalVibration, CreepWithoutAForceIsNoMode)
{
  auto data = two_modes(10., 400.);
  data.face_compliance.reinit(3, 3);
  for (unsigned int i = 0; i < 3; ++i)
    data.face_compliance(i, i) = 0.02;
  data.relaxation       = 0.01;
  auto forces           = no_forces({ 0, 1, 2 });
  forces.pressure(0, 0) = -5.;
  const auto modes      = modal_vibrations(data, forces);
  // Two vibrations, and one shape that creeps under its force.
  ASSERT_EQ(modes.size(), 3u);
  for (const auto &mode : modes)
  {
    EXPECT_GT(std::abs(1. + mode.eigenvalue * data.relaxation), 1e-3) << mode.eigenvalue;
    EXPECT_LT(mode.residual, 1e-12);
    for (const auto &part : mode.face_force)
      for (const double force : part)
        EXPECT_TRUE(std::isfinite(force)) << mode.eigenvalue;
  }
}

// The eleventh power of ten between the highest and the lowest: the low one keeps its digits.
TEST(ModalVibration, LowEigenvaluesKeepTheirDigitsBesideHighOnes)
{
  auto data             = two_modes(7., 1e13);
  auto forces           = no_forces({ 0, 1 });
  forces.pressure(0, 0) = -2.;
  forces.friction(0, 1) = 1.;
  const auto found      = eigenvalues(data, forces);
  ASSERT_GE(found.size(), 1u);
  expect_near(found[0], { 0., 3. }, 1e-14);
}

TEST(ModalVibration, WithoutStiffnessIsAnError)
{
  auto data             = two_modes(10., 11.);
  auto forces           = no_forces({ 0 });
  forces.pressure(0, 0) = 10.;
  EXPECT_ANY_THROW(modal_vibrations(data, forces));
}
