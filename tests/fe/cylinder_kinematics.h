// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "fe/solid/cylinder_point.h"

#include <deal.II/base/tensor.h>

namespace sprag
{
  /// Slips of a point of the lever, round the cylinder and along it [mm].
  inline std::array<double, 2> slips_of(const RigidCylinder &cylinder, const RigidCylinder::Pose &at,
                                        const dealii::Point<3> &point)
  {
    const Triple<double> place{ point[0], point[1], point[2] };
    return { { cylinder.slip(at, point), seen(cylinder.shape(), at, place).along } };
  }

  /// Gap and slips of a point of the lever against the cylinder, with derivatives by the coordinates (displacement along xi, eta
  /// and zeta, theta, x, tilt, skew): dual numbers of dual numbers.
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

    SurfaceKinematics(const RigidCylinder &cylinder, const RigidCylinder::Pose &at, const dealii::Point<3> &point)
    {
      using N          = Dual<Dual<double, n>, n>;
      const auto place = [](const double value, const int i)
      {
        N result;
        result.v      = variable<Dual<double, n>>(value, i);
        result.d[i].v = 1.;
        return result;
      };
      const auto slope = [&](const unsigned int i) { return place(cylinder.slopes()[i] + at.turned[i], 5 + i); };
      const auto pose  = cylinder_pose(place(at.x, 4), place(at.theta, 3), slope(0), slope(1));
      const auto found = seen(cylinder.shape(), pose, Triple<N>{ place(point[0], 0), place(point[1], 1), place(point[2], 2) });
      const N round    = cylinder.shape().radius *
                      angle_between(1., 0., dot(found.from_centre, pose.axes.upward), -dot(found.from_centre, pose.axes.right));
      set(found.gap, gap, gap_row, gap_curvature);
      set(round, slip[0], slip_row[0], slip_curvature[0]);
      set(found.along, slip[1], slip_row[1], slip_curvature[1]);
    }

  private:
    static void set(const Dual<Dual<double, n>, n> &of, double &value, Row &row, Curvature &curvature)
    {
      value = of.v.v;
      for (unsigned int i = 0; i < n; ++i)
      {
        row[i] = of.v.d[i];
        for (unsigned int j = 0; j < n; ++j)
          curvature[i][j] = of.d[i].d[j];
      }
    }
  };
} // namespace sprag
