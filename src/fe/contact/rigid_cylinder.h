// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "base/dual.h"
#include "scene/apparatus.h"
#include "scene/lever.h"

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <array>

namespace sprag
{
  /// A vector in space of any kind of number.
  template <class N>
  struct Triple
  {
    N x{}, y{}, z{};
  };

  template <class A, class B>
  SPRAG_PART auto operator+(const Triple<A> &a, const Triple<B> &b)
  {
    return Triple<decltype(a.x + b.x)>{ a.x + b.x, a.y + b.y, a.z + b.z };
  }
  template <class A, class B>
  SPRAG_PART auto operator-(const Triple<A> &a, const Triple<B> &b)
  {
    return Triple<decltype(a.x - b.x)>{ a.x - b.x, a.y - b.y, a.z - b.z };
  }
  template <class A, class B>
  SPRAG_PART auto operator*(const A &factor, const Triple<B> &a)
  {
    return Triple<decltype(factor * a.x)>{ factor * a.x, factor * a.y, factor * a.z };
  }
  template <class A, class B>
  SPRAG_PART auto dot(const Triple<A> &a, const Triple<B> &b)
  {
    return a.x * b.x + a.y * b.y + a.z * b.z;
  }
  template <class A, class B>
  SPRAG_PART auto cross(const Triple<A> &a, const Triple<B> &b)
  {
    return Triple<decltype(a.x * b.x)>{ a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x };
  }

  /// Slopes of a cylinder's axis towards the lever (tilt) and along x (skew).
  using AxisSlopes = std::array<double, 2>;

  /// Axes of a cylinder in those of the world: `axis` lies along (skew, tilt, 1), `right` has no part towards the lever, `upward`
  /// is across both.
  template <class A>
  struct CylinderAxes
  {
    Triple<A> axis, right, upward;

    /// The same with a function of each number.
    template <class Map>
    SPRAG_PART auto each(const Map &map) const
    {
      const auto map_triple = [&](const Triple<A> &a) { return Triple<decltype(map(a.x))>{ map(a.x), map(a.y), map(a.z) }; };
      return CylinderAxes<decltype(map(axis.x))>{ map_triple(axis), map_triple(right), map_triple(upward) };
    }
  };

  template <class A>
  CylinderAxes<A> cylinder_axes(const A &tilt, const A &skew)
  {
    const auto unit = [](const Triple<A> &a) { return 1. / square_root(dot(a, a)) * a; };
    CylinderAxes<A> result{ unit({ skew, tilt, A{} + 1. }), unit({ A{} + 1., A{}, -skew }), {} };
    result.upward = cross(result.axis, result.right);
    return result;
  }

  /// A cylinder at its position x from the pivot frame's origin before a lever inclined by theta. A is the kind of number of the
  /// axes: a plain one of a cylinder that is fixed on its shaft.
  template <class N, class A = N>
  struct CylinderPose
  {
    N x, cosine, sine; ///< of theta
    CylinderAxes<A> axes;
    CylinderAxes<A> by_slope[2]; ///< derivatives of the axes by the slopes
  };

  template <class N, class A>
  CylinderPose<N, A> cylinder_pose(const N &x, const N &theta, const A &tilt, const A &skew)
  {
    using Slope     = Dual<A, 2>;
    const A one     = A{} + 1.;
    const auto axes = cylinder_axes(Slope{ tilt, { one, A{} } }, Slope{ skew, { A{}, one } });
    return { x,
             cosine(theta),
             sine(theta),
             axes.each([](const Slope &a) { return a.v; }),
             { axes.each([](const Slope &a) { return a.d[0]; }), axes.each([](const Slope &a) { return a.d[1]; }) } };
  }

  template <class N, class A>
  SPRAG_PART auto to_batch(const CylinderPose<N, A> &pose)
  {
    const auto widen = [](const A &a) { return to_batch(a); };
    return CylinderPose<decltype(to_batch(pose.x)), decltype(widen(pose.axes.axis.x))>{ to_batch(pose.x),
                                                                                        to_batch(pose.cosine),
                                                                                        to_batch(pose.sine),
                                                                                        pose.axes.each(widen),
                                                                                        { pose.by_slope[0].each(widen),
                                                                                          pose.by_slope[1].each(widen) } };
  }

  /// Returns a place, those of a plane at zeta = 0.
  template <int dim>
  dealii::Point<3> in_space(const dealii::Point<dim> &place)
  {
    dealii::Point<3> result;
    for (unsigned int d = 0; d < dim; ++d)
      result[d] = place[d];
    return result;
  }

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

    /// Constants that determine gaps and slips of points, beside the pose.
    struct Shape
    {
      double pivot_distance, pivot_height; ///< of the lever [mm]
      double radius;                       ///< R [mm]
      double half_length;                  ///< infinite without ends [mm]
      double position;                     ///< of the middle, along zeta [mm]
      double edge_radius;                  ///< 0 without rounding [mm]
      double crown;                        ///< curvature of the barrel [1/mm]

      /// Share of the rounding's depth beyond which the end is a wall.
      static constexpr double rounding_end = 0.999;

      /// Bound of the slope of barrel and rounding within some distance from the middle [mm].
      double largest_slope(double distance) const;
    };

    const Shape shape;
    const AxisSlopes slopes;  ///< of the axis in the scene
    const bool has_free_axis; ///< whether the shaft lets the axis yield

    /// Returns the gap of a point of the lever, beyond the cylinder's ends at least the distance from them [mm], and its gradient
    /// by the place of the point, in lever axes.
    std::pair<double, dealii::Tensor<1, 3>> gap_and_gradient(const Pose &pose, const dealii::Point<3> &point) const;

    /// Returns the slip coordinate of a point round the cylinder [mm].
    double slip(const Pose &pose, const dealii::Point<3> &point) const;

    /// Returns by how much gap and slips, round and along the cylinder, change as a point, the cylinder's position and its slopes
    /// do [mm].
    std::array<double, 3> changes(const Pose &pose, const dealii::Point<3> &point, const dealii::Tensor<1, 3> &moved, double x,
                                  double theta, const AxisSlopes &turned) const;

    // Places of the cylinder at x = 0 with the scene's slopes in the axes of the world, see DevicePose; `along` counts from the
    // middle [mm].
    dealii::Point<3> on_axis(double along) const;
    dealii::Point<3> on_surface(double along, double angle) const;

  private:
    const CylinderAxes<double> axes_at_rest;
  };
} // namespace sprag
