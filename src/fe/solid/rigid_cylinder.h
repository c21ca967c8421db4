// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "fe/solid/cylinder_pose.h"
#include "scene/apparatus.h"
#include "scene/lever.h"

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <array>

namespace sprag
{
  /// The damper's cylinder as a rigid body of finite length: its axis may lie out of true, by slopes towards the lever (tilt) and
  /// along x (skew), it may be a barrel and have rounded ends. Distances are measured across the axis: barrel and rounding are
  /// added to them as a profile over the place s along the axis, which is exact up to the square of their slope.
  class RigidCylinder
  {
  public:
    RigidCylinder(const Geometry &geometry, const Cylinder &cylinder);

    /// The cylinder at its position x from the pivot frame's origin, before a lever inclined by theta, its axis turned beyond the
    /// scene's slopes.
    struct Pose : CylinderPose<double>
    {
      double theta      = 0.;
      AxisSlopes turned = {};
    };

    Pose pose(double x, double theta, const AxisSlopes &turned = {}) const;

    /// What gaps and slips of points follow from, beside the pose.
    struct Shape
    {
      double pivot_distance, pivot_height; ///< of the lever [mm]
      double radius;                       ///< R [mm]
      double half_length;                  ///< infinite without ends [mm]
      double position;                     ///< of the middle, along zeta [mm]
      double edge_radius;                  ///< 0 without rounding [mm]
      double crown;                        ///< curvature of the barrel [1/mm]

      /// Share of the rounding's depth beyond which the end is a wall.
      static constexpr double last_of_rounding = 0.999;

      /// Bound of the slope of barrel and rounding within some distance from the middle [mm].
      double largest_slope(double distance) const;
    };

    const Shape &shape() const
    {
      return of;
    }

    /// Of the scene.
    const AxisSlopes &slopes() const
    {
      return at_rest;
    }

    /// Returns the gap of a point of the lever; beyond the cylinder's ends it is at least the distance from them [mm].
    double gap(const Pose &pose, const dealii::Point<3> &point) const;

    /// Returns it and its gradient by the place of the point, in lever axes.
    std::pair<double, dealii::Tensor<1, 3>> gap_and_gradient(const Pose &pose, const dealii::Point<3> &point) const;

    /// Returns the slip coordinate of a point round the cylinder [mm].
    double slip(const Pose &pose, const dealii::Point<3> &point) const;

    /// Returns by how much gap and slips, round and along the cylinder, change as a point, the cylinder's position and its slopes
    /// do [mm].
    std::array<double, 3> changes(const Pose &pose, const dealii::Point<3> &point, const dealii::Tensor<1, 3> &moved, double x,
                                  double theta, const AxisSlopes &turned) const;

    /// Whether its shaft lets the axis yield.
    bool has_free_axis() const
    {
      return is_free;
    }

    // Places of the cylinder at x = 0 with the scene's slopes in the axes of the world, see DevicePose; `along` counts from the
    // middle [mm].
    dealii::Point<3> on_axis(double along) const;
    dealii::Point<3> on_surface(double along, double angle) const;

  private:
    const Shape of;
    const AxisSlopes at_rest;
    const bool is_free;
    const CylinderAxes<double> axes_at_rest;
  };
} // namespace sprag
