// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "fe/contact/cylinder_point.h"

#include <deal.II/base/tensor.h>

namespace sprag
{
  /// Gap and slips of a point of the lever against the cylinder, with derivatives by the coordinates (displacement along xi, eta
  /// and zeta, theta, x, tilt, skew).
  struct SurfaceKinematics
  {
    static constexpr int n = 7;
    using Row              = dealii::Tensor<1, n>;
    using Curvature        = dealii::Tensor<2, n>;

    double gap = 0.;
    Row gap_row;
    Curvature gap_curvature;
    std::array<double, 2> slip{};
    std::array<Row, 2> slip_row;
    std::array<Curvature, 2> slip_curvature;
  };

  /// Finds them for points at one pose of the cylinder, by dual numbers of dual numbers.
  class KinematicsAtPose
  {
  public:
    KinematicsAtPose(const RigidCylinder &cylinder, const RigidCylinder::Pose &at)
        : shape(cylinder.shape)
        , pose(cylinder_pose(variable_at(at.x, 4), variable_at(at.theta, 3), variable_at(cylinder.slopes[0] + at.turned[0], 5),
                             variable_at(cylinder.slopes[1] + at.turned[1], 6)))
    {
    }

    SurfaceKinematics operator()(const dealii::Point<3> &point) const
    {
      SurfaceKinematics result;
      const auto found =
          seen(shape, pose, Triple<N>{ variable_at(point[0], 0), variable_at(point[1], 1), variable_at(point[2], 2) });
      const N round = shape.radius *
                      angle_between(1., 0., dot(found.from_centre, pose.axes.upward), -dot(found.from_centre, pose.axes.right));
      set(found.gap, result.gap, result.gap_row, result.gap_curvature);
      set(round, result.slip[0], result.slip_row[0], result.slip_curvature[0]);
      set(found.along, result.slip[1], result.slip_row[1], result.slip_curvature[1]);
      return result;
    }

  private:
    static constexpr int n = SurfaceKinematics::n;
    using N                = Dual<Dual<double, n>, n>;

    static N variable_at(const double value, const int i)
    {
      N result;
      result.v      = variable<Dual<double, n>>(value, i);
      result.d[i].v = 1.;
      return result;
    }

    static void set(const N &from, double &value, SurfaceKinematics::Row &row, SurfaceKinematics::Curvature &curvature)
    {
      value = from.v.v;
      for (unsigned int i = 0; i < n; ++i)
      {
        row[i] = from.v.d[i];
        for (unsigned int j = 0; j < n; ++j)
          curvature[i][j] = from.d[i].d[j];
      }
    }

    const RigidCylinder::Shape shape;
    const CylinderPose<N> pose;
  };
} // namespace sprag
