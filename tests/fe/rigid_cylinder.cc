// SPDX-License-Identifier: GPL-3.0-only
#include "cylinder_kinematics.h"

#include "model/contact/circle.h"
#include "scenes.h"

#include <cmath>
#include <gtest/gtest.h>

using namespace sprag;

namespace
{
  /// Out of true, a barrel with rounded ends.
  Cylinder barrel()
  {
    Cylinder cylinder;
    cylinder.length       = 40.;
    cylinder.position     = 3.;
    cylinder.tilt         = 0.02;
    cylinder.skew         = -0.03;
    cylinder.crown_radius = 900.;
    cylinder.edge_radius  = 4.;
    return cylinder;
  }

  using Coordinates = SurfaceKinematics::Row; // place along xi, eta, zeta, theta, x, tilt and skew beyond the scene's

  SurfaceKinematics at(const RigidCylinder &cylinder, const Coordinates &q)
  {
    return KinematicsAtPose(cylinder, cylinder.pose(q[4], q[3], { { q[5], q[6] } }))(dealii::Point<3>(q[0], q[1], q[2]));
  }

  /// Central differences of what a function tells of the kinematics.
  template <class Function>
  Coordinates differences(const RigidCylinder &cylinder, const Coordinates &q, const Function &function)
  {
    Coordinates result;
    for (unsigned int i = 0; i < SurfaceKinematics::n; ++i)
    {
      const double step = i == 3 || i > 4 ? 1e-6 : 1e-4;
      auto before = q, after = q;
      before[i] -= step;
      after[i] += step;
      result[i] = (function(at(cylinder, after)) - function(at(cylinder, before))) / (2. * step);
    }
    return result;
  }
} // namespace

TEST(RigidCylinder, RowsAndCurvaturesAreDerivatives)
{
  const RigidCylinder cylinder(model_a().geometry, barrel());
  for (const double zeta : { 2., 20.5, -14.6 }) // in the middle, and in both roundings
  {
    const Coordinates q({ 121., 45.57, zeta, 0.086, 64., -0.01, 0.02 });
    const auto found = at(cylinder, q);
    EXPECT_LT((differences(cylinder, q, [](const auto &k) { return k.gap; }) - found.gap_row).norm(), 1e-6);
    for (unsigned int s = 0; s < 2; ++s)
      EXPECT_LT((differences(cylinder, q, [s](const auto &k) { return k.slip[s]; }) - found.slip_row[s]).norm(), 1e-6);
    for (unsigned int i = 0; i < SurfaceKinematics::n; ++i)
    {
      EXPECT_LT((differences(cylinder, q, [i](const auto &k) { return k.gap_row[i]; }) - found.gap_curvature[i]).norm(), 1e-5);
      for (unsigned int s = 0; s < 2; ++s)
        EXPECT_LT(
            (differences(cylinder, q, [i, s](const auto &k) { return k.slip_row[s][i]; }) - found.slip_curvature[s][i]).norm(),
            1e-5);
    }
    const auto pose = cylinder.pose(q[4], q[3], { { q[5], q[6] } });
    const dealii::Point<3> point(q[0], q[1], q[2]);
    const auto [gap, gradient] = cylinder.gap_and_gradient(pose, point);
    const Coordinates moved({ 0.3, -0.2, 0.7, 0.01, 0.4, -0.02, 0.05 });
    const auto changes = cylinder.changes(pose, point, dealii::Tensor<1, 3>({ moved[0], moved[1], moved[2] }), moved[4], moved[3],
                                          { { moved[5], moved[6] } });
    EXPECT_NEAR(changes[0], found.gap_row * moved, 1e-12);
    for (unsigned int s = 0; s < 2; ++s)
      EXPECT_NEAR(changes[1 + s], found.slip_row[s] * moved, 1e-12);
    EXPECT_NEAR(cylinder.slip(pose, point), found.slip[0], 1e-12);
    EXPECT_NEAR(gap, found.gap, 1e-12);
    for (unsigned int d = 0; d < 3; ++d)
      EXPECT_NEAR(gradient[d], found.gap_row[d], 1e-12);
  }
}

TEST(RigidCylinder, IsACircleInAPlaneWhereItIsTrue)
{
  const Geometry geometry = model_a().geometry;
  const RigidCylinder cylinder(geometry, {});
  const auto solid = at(cylinder, Coordinates({ 121., 45.57, 7., 0.086, 64., 0., 0. }));
  using N          = Dual<double, 4>;
  const auto plane =
      on_circle(placed_circle(geometry, variable<N>(64., 3), variable<N>(0.086, 2)), variable<N>(121., 0), variable<N>(45.57, 1));
  const unsigned int plane_index[] = { 0, 1, 3, 4 };
  EXPECT_NEAR(solid.gap, plane.gap.v, 1e-12);
  EXPECT_NEAR(solid.slip[0], plane.slip.v, 1e-12);
  EXPECT_NEAR(solid.slip[1], 7., 1e-12);
  for (unsigned int i = 0; i < 4; ++i)
  {
    EXPECT_NEAR(solid.gap_row[plane_index[i]], plane.gap_row[i].v, 1e-12);
    EXPECT_NEAR(solid.slip_row[0][plane_index[i]], plane.slip_row[i].v, 1e-12);
    for (unsigned int j = 0; j < 4; ++j)
    {
      EXPECT_NEAR(solid.gap_curvature[plane_index[i]][plane_index[j]], plane.gap_row[i].d[j], 1e-10);
      EXPECT_NEAR(solid.slip_curvature[0][plane_index[i]][plane_index[j]], plane.slip_row[i].d[j], 1e-10);
    }
  }
}

TEST(RigidCylinder, BeyondItsEndsNothingTouches)
{
  Cylinder cylinder;
  cylinder.length = 30.;
  const RigidCylinder rounded(model_a().geometry, cylinder);
  const auto pose = rounded.pose(64., 0.086);
  EXPECT_LT(rounded.gap_and_gradient(pose, { 121., 45., 14.9 }).first, 0.);
  EXPECT_NEAR(rounded.gap_and_gradient(pose, { 121., 45., 17. }).first, 2., 1e-12);
}

// Half of a slope by the scene and half by the shaft is the whole by the scene.
TEST(RigidCylinder, SlopesOfTheSceneAndOfItsShaftAddUp)
{
  Cylinder half = barrel(), whole = barrel();
  half.tilt *= 0.5;
  half.skew *= 0.5;
  const RigidCylinder turned(model_a().geometry, half), fixed(model_a().geometry, whole);
  const auto found    = at(turned, Coordinates({ 121., 45.57, 20.5, 0.086, 64., half.tilt, half.skew }));
  const auto expected = at(fixed, Coordinates({ 121., 45.57, 20.5, 0.086, 64., 0., 0. }));
  EXPECT_EQ(found.gap, expected.gap);
  EXPECT_LT((found.gap_curvature - expected.gap_curvature).norm(), 1e-12);
}
