// SPDX-License-Identifier: GPL-3.0-only
#include "fe/body/material.h"

#include "base/errors.h"
#include "support/solid.h"

#include <cmath>
#include <gtest/gtest.h>

using namespace sprag;

namespace
{
  using Gradient = dealii::Tensor<2, 2>;

  const Lame constants = plane_constants({ 20., 0.3 }, PlaneState::strain);

  const std::vector<Gradient> deformations = { gradient(1., 0., 0., 1.), gradient(1.1, 0.2, -0.1, 0.9),
                                               gradient(0.6, -0.5, 0.7, 1.4), gradient(1.02, 0.01, 0.03, 0.97) };

  Stress<2> linear_elastic(const Lame &lame, const Gradient &displacement)
  {
    return compute_stress<2>(MaterialModel::linear, lame, displacement);
  }

  Stress<2> neo_hookean(const Lame &lame, const Gradient &deformation)
  {
    return compute_stress<2>(MaterialModel::neo_hookean, lame, deformation - deformations[0]);
  }

  Gradient moved(Gradient deformation, const unsigned int i, const double h)
  {
    deformation[i / 2][i % 2] += h;
    return deformation;
  }

  // Stresses of up to 50 MPa, whose third derivatives for J > 0.8 are below 1e3 MPa: h^2 / 6 of those and 1e-14 MPa / h.
  double allowed(const double h)
  {
    return 200. * h * h + 2e-14 / h;
  }
} // namespace

TEST(NeoHookean, TangentIsTheDerivativeOfTheStress)
{
  for (const auto &deformation : deformations)
    for (unsigned int j = 0; j < 4; ++j)
      for (const double h : { 1e-3, 1e-4, 1e-5 })
      {
        const auto right   = neo_hookean(constants, moved(deformation, j, h)).piola;
        const auto left    = neo_hookean(constants, moved(deformation, j, -h)).piola;
        const auto tangent = neo_hookean(constants, deformation).tangent;
        for (unsigned int i = 0; i < 4; ++i)
          EXPECT_NEAR(tangent[i][j], (right[i / 2][i % 2] - left[i / 2][i % 2]) / (2. * h), 2. * allowed(h)) << i << j;
      }
}

TEST(NeoHookean, MatterTurnedInsideOutEndsTheStep)
{
  EXPECT_THROW(neo_hookean(constants, gradient(-0.1, 0., 0., 1.)), AnalysisError);
  EXPECT_THROW(neo_hookean(constants, gradient(0., 0., 0., 1.)), AnalysisError);
}

// Pulled along one axis with the other free, eps_22 / eps_11 = -lambda / (lambda + 2 mu).
TEST(PlaneConstants, PullingMeetsYoungsModulus)
{
  const auto modulus = [](const Lame &plane)
  {
    const double ratio = plane.lambda / (plane.lambda + 2. * plane.mu);
    return linear_elastic(plane, gradient(1., 0., 0., -ratio)).piola[0][0];
  };
  for (const double nu : { 0., 0.33, 0.49 })
  {
    EXPECT_NEAR(modulus(plane_constants({ 20., nu }, PlaneState::stress)), 20., 1e-12);
    EXPECT_NEAR(modulus(plane_constants({ 20., nu }, PlaneState::strain)), 20. / (1. - nu * nu), 1e-12);
  }
}
