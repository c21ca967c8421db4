// SPDX-License-Identifier: GPL-3.0-only
#include "model/structure/modal_vibration.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

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
