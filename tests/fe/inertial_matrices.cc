// SPDX-License-Identifier: GPL-3.0-only
#include "fe/dynamics/inertial_matrices.h"

#include "bar.h"
#include "base/errors.h"
#include "fe/algebra/compressed_rows.h"
#include "mpi_environment.h"

#include <gtest/gtest.h>

using namespace sprag;

namespace
{
  using Matrix = dealii::PETScWrappers::SparseMatrix;
  using Vector = dealii::Vector<double>;

  constexpr double tip_mass          = 1e-6;
  constexpr double moment_of_inertia = 1e-3;

  Vector product(const Matrix &matrix, const Vector &vector)
  {
    Vector result(vector.size());
    CompressedRows(matrix).multiply<1>({ { &vector } }, { { &result } });
    return result;
  }

  /// Mass, and its first and second moments about the pivot, of the lever's rectangles at the given densities.
  struct Moments
  {
    double mass = 0., along = 0., across = 0., inertia = 0.;

    void add(const double density, const double length, const double from, const double to, const double width)
    {
      const double part = density * length * (to - from) * width;
      mass += part;
      along += part * 0.5 * length;
      across += part * 0.5 * (from + to);
      inertia += part * (length * length + from * from + from * to + to * to) / 3.;
    }
  };

  Moments compute_moments(const Bar &bar, const double factor)
  {
    Moments result;
    const double middle = bar.offset + bar.layer;
    result.add(factor * 2e-10, bar.length, bar.offset, middle, bar.width);
    result.add(factor * 2.7e-9, bar.length, middle, middle + bar.depth, bar.width);
    return result;
  }
} // namespace

TEST(InertialMatrices, RigidRotationCostsNothing)
{
  const MeshedBar bar({});
  const InertialMatrices matrices(*bar, bar_inertia(moment_of_inertia, 0.));
  const auto turned = matrices.coordinates.rigid_rotation();
  // Round-off of stresses of the size of Young's modulus, 7e4 MPa, on areas of some 10 mm^2, displaced by 20 mm.
  EXPECT_NEAR(product(matrices.stiffness, turned).linfty_norm(), 0., 1e-13 * 7e4 * 10. * 20.);
  EXPECT_NEAR(product(matrices.layer_stiffness, turned).linfty_norm(), 0., 1e-13 * 20. * 10. * 20.);
  EXPECT_NEAR(matrices.coordinates.elastic_displacement(turned).linfty_norm(), 0., 1e-14 * 20.);
}

TEST(InertialMatrices, HasTheMomentOfInertiaOfTheScene)
{
  const MeshedBar bar({});
  for (const double tip : { 0., tip_mass })
  {
    auto inertia         = bar_inertia(moment_of_inertia, tip);
    inertia.leaf.inertia = tip > 0. ? 0.1 * moment_of_inertia : 0.;
    const InertialMatrices matrices(*bar, inertia);
    const auto turned = matrices.coordinates.rigid_rotation();
    EXPECT_NEAR(turned * product(matrices.mass, turned), moment_of_inertia, 1e-12 * moment_of_inertia);
  }
}

TEST(InertialMatrices, ScalesTheDensitiesAndNotTheTip)
{
  const Bar shape;
  const MeshedBar bar(shape);
  const InertialMatrices matrices(*bar, bar_inertia(moment_of_inertia, tip_mass));
  const double low         = shape.offset + shape.layer;
  const double high        = low + shape.depth;
  const double tip_inertia = tip_mass * (shape.length * shape.length + (low * low + low * high + high * high) / 3.);
  const double factor      = (moment_of_inertia - tip_inertia) / compute_moments(shape, 1.).inertia;
  EXPECT_NEAR(matrices.density_factor, factor, 1e-12 * factor);
  const auto moments = compute_moments(shape, factor);
  EXPECT_NEAR(matrices.total_mass, moments.mass + tip_mass, 1e-12 * moments.mass);
  // In rotation the momentum is the mass times the velocity of its centre, (-eta, xi).
  const auto turned = matrices.coordinates.rigid_rotation();
  EXPECT_NEAR(matrices.momentum[0] * turned, -moments.across - tip_mass * 0.5 * (low + high), 1e-12 * moments.along);
  EXPECT_NEAR(matrices.momentum[1] * turned, moments.along + tip_mass * shape.length, 1e-12 * moments.along);
}
