// SPDX-License-Identifier: GPL-3.0-only
#include "laws/friction_law.h"
#include "scene/scene.h"
#include "verification/rigid_block.h"

#include <gtest/gtest.h>

using namespace sprag;

// A block of weight G is pushed up a slope of tangent 0.1 by a horizontal force F: F / G = (tan a + mu) / (1 - mu tan a), and
// let down again with friction the other way. The force comes from an actuator through a spring, so that it adjusts itself.

namespace
{
  constexpr double slope  = 0.1;
  constexpr double weight = 100.; ///< [N]

  const double cosine = 1. / std::sqrt(1. + slope * slope);
  const double sine   = slope * cosine;

  /// Displacements along x and upwards; the actuator is at the drive's x.
  RigidBlock<2>::Properties block(const Enforcement enforcement, const FrictionLaw &friction)
  {
    const double spring = 1000.;
    const auto load     = [=](const dealii::Tensor<1, 2> &u, const double x)
    {
      RigidBlock<2>::Load result;
      result.force[0]         = spring * (x - u[0]);
      result.force[1]         = -weight;
      result.derivative[0][0] = -spring;
      return result;
    };
    const auto contact = [](const dealii::Tensor<1, 2> &u)
    {
      ContactKinematics<2> result;
      result.gap_row  = dealii::Tensor<1, 2>({ -sine, cosine });
      result.gap      = result.gap_row * u;
      result.slip_row = dealii::Tensor<1, 2>({ cosine, sine });
      result.slip     = result.slip_row * u;
      return result;
    };
    return { load, contact, friction, 1e4, enforcement, dealii::Tensor<1, 2>({ 0., -1e-3 }) };
  }

  double push(const double mu)
  {
    return (slope + mu) / (1. - mu * slope);
  }

  constexpr double speed = 50.; ///< [mm/s]

  std::vector<Row> moved(const RigidBlock<2>::Properties &properties)
  {
    return run_block<2>(properties, Drive(DriveProfile::triangle, 0., 10., speed, 1.), 1.);
  }

  /// Rows after the spring has been tightened or relaxed, 40 N / 1000 N/mm, in sliding.
  std::vector<Row> sliding(const std::vector<Row> &rows, const double direction)
  {
    std::vector<Row> result;
    for (const Row &row : rows)
      if (row[Column::v] * direction > 0. && row[Column::x] > 0.5 && (direction > 0. || row[Column::x] < 9.5))
        result.push_back(row);
    EXPECT_GE(result.size(), 8u);
    return result;
  }
} // namespace

TEST(BlockOnASlope, IsPushedUpAndLetDownByTheForcesOfStatics)
{
  EXPECT_NEAR(push(0.1), 0.202020, 5e-7); // the reference's printed digits
  for (const auto enforcement : { Enforcement::penalty, Enforcement::augmented_lagrangian })
    for (const double mu : { 0.1, 0.09, 0.3 })
    {
      const auto rows = moved(block(enforcement, { CoulombFriction{ mu }, FrictionSpeed::sliding }));
      // The spring's force is a difference of positions of 10 mm: round-off of 1e-15 mm times 1000 N/mm, over 100 N.
      for (const Row &row : sliding(rows, 1.))
      {
        EXPECT_NEAR(row[Column::Q] / weight, push(mu), 1e-11);
        EXPECT_NEAR(row[Column::F] / row[Column::P], mu, 1e-12);
      }
      for (const Row &row : sliding(rows, -1.))
      {
        EXPECT_NEAR(row[Column::Q] / weight, push(-mu), 1e-11);
        EXPECT_NEAR(row[Column::F] / row[Column::P], -mu, 1e-12);
      }
    }
}

TEST(BlockOnASlope, FeelsTheFrictionOfItsSlidingSpeed)
{
  const FrictionLaw cork{ CorkOnAluminium{}, FrictionSpeed::sliding };
  const auto rows = moved(block(Enforcement::penalty, cork));
  // The block itself moves along the slope, 1 / cos a times as fast as the actuator, once the force is steady.
  const double mu = friction_coefficient(cork, speed / cosine).coefficient;
  EXPECT_NEAR(sliding(rows, 1.).back()[Column::Q] / weight, push(mu), 1e-9);
  EXPECT_NEAR(sliding(rows, -1.).back()[Column::Q] / weight, push(-mu), 1e-9);
}

TEST(BlockOnASlope, WorkOfTheActuatorIsLostToFriction)
{
  // Twice the same way: what the weight and the spring take on one stroke they give back on the other.
  const double mu       = 0.3;
  const auto properties = block(Enforcement::penalty, { CoulombFriction{ mu }, FrictionSpeed::sliding });
  const auto residual   = [&](const double step)
  {
    const auto rows = run_block<2>(properties, Drive(DriveProfile::triangle, 0., 10., speed, 3.), step);
    // The work is that of the two later cycles, which begin and end alike.
    const auto begin  = std::find_if(rows.begin() + 1, rows.end(), [](const Row &row) { return row[Column::x] == 0.; });
    const double lost = rows.back()[Column::friction_work] - (*begin)[Column::friction_work];
    return std::abs((rows.back()[Column::drive_work] - (*begin)[Column::drive_work]) / lost - 1.);
  };
  // The trapezoidal rule errs where the friction power jumps from stick to slip, within a step there.
  EXPECT_LT(residual(1.), 2e-3);
}
