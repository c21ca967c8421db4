// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "fe/contact/rigid_cylinder.h"
#include "laws/point_law.h"

namespace sprag
{
  /// A point of the lever as the cylinder sees it, in the axes of the world. A is the kind of number of the cylinder's axes.
  template <class N, class A = N>
  struct SeenPoint
  {
    Triple<N> from_centre;
    N along; ///< place s along the axis, and slip coordinate there [mm]
    Triple<N> normal;
    Triple<N> round; ///< the way the angle about the axis grows
    N radius;        ///< distance from the axis [mm]
    N gap;           ///< [mm], positive when open; beyond the cylinder's ends at least the distance from them
    N profile_slope;
  };

  /// The depth by which the cylinder's surface lies back at a place along the axis, and its slope there.
  template <class N>
  struct CylinderProfile
  {
    N depth, slope;
  };

  template <class N>
  SPRAG_PART CylinderProfile<N> profile_at(const RigidCylinder::Shape &cylinder, const N &along)
  {
    CylinderProfile<N> result{ 0.5 * cylinder.crown * (along * along), cylinder.crown * along };
    if (cylinder.edge_radius == 0.)
      return result;
    const double radius = cylinder.edge_radius;
    const auto is_left  = value(along) < 0.;
    const N from_middle = select(is_left, N(-along), along);
    const N into        = 1. / radius * (from_middle - (cylinder.half_length - radius));
    const auto inside   = value(into) > 0.;
    const N last        = N{} + RigidCylinder::Shape::rounding_end;
    const N share       = select(inside, select(value(into) < value(last), into, last), N{});
    const N root        = square_root(N(1. - share * share));
    const N slope       = share / root;
    result.depth        = result.depth + radius * (1. - root);
    result.slope        = result.slope + select(is_left, N(-slope), slope);
    return result;
  }

  /// A vector of the lever along xi, eta and zeta in the axes of the world, which are x, y (from the x-axis to the lever) and z
  /// (along zeta), and back.
  template <class P, class N>
  SPRAG_PART auto in_world(const P &pose, const Triple<N> &a)
  {
    return Triple<decltype(pose.sine * a.x)>{ pose.sine * a.y - pose.cosine * a.x, pose.sine * a.x + pose.cosine * a.y,
                                              decltype(pose.sine * a.x){} + a.z };
  }
  template <class P, class N>
  SPRAG_PART auto in_lever(const P &pose, const Triple<N> &a)
  {
    return in_world(pose, a); // it is a reflection
  }

  template <class P, class A, class N>
  SPRAG_PART auto seen(const RigidCylinder::Shape &cylinder, const CylinderPose<P, A> &pose, const Triple<N> &point)
  {
    using R = decltype(pose.x + point.x);
    SeenPoint<R> result;
    const auto at        = in_world(pose, point);
    result.from_centre   = { at.x - pose.x + cylinder.pivot_distance, at.y + cylinder.pivot_height, at.z - cylinder.position };
    result.along         = dot(result.from_centre, pose.axes.axis);
    const auto across    = result.from_centre - result.along * pose.axes.axis;
    result.radius        = square_root(dot(across, across));
    result.normal        = 1. / result.radius * across;
    result.round         = cross(pose.axes.axis, result.normal);
    const auto profile   = profile_at(cylinder, result.along);
    result.profile_slope = profile.slope;
    const R gap          = result.radius - cylinder.radius + profile.depth;
    const R from_middle  = select(value(result.along) < 0., R(-result.along), result.along);
    const R beyond       = from_middle - cylinder.half_length;
    result.gap           = select(value(beyond) > value(gap), beyond, gap);
    return result;
  }

  /// The change of the slip round the cylinder since a place had these parts along its axes.
  template <class N, class V, class A>
  SPRAG_PART N slip_round(const RigidCylinder::Shape &cylinder, const V &right, const V &upward, const Triple<N> &from_centre,
                          const CylinderAxes<A> &axes)
  {
    return cylinder.radius * angle_between(upward, V(-right), N(dot(from_centre, axes.upward)), N(-dot(from_centre, axes.right)));
  }

  /// The force on the lever, in the axes of the world, of a pressure and of tractions round and along the cylinder. They do the
  /// virtual work of gap and slips.
  template <class N, class A, int slips>
  SPRAG_PART Triple<N> point_force(const RigidCylinder::Shape &cylinder, const SeenPoint<N> &at, const Triple<A> &axis,
                                   const N &pressure, const Several<N, slips> &traction)
  {
    const auto result = pressure * at.normal - (cylinder.radius * traction[0] / at.radius) * at.round;
    if constexpr (slips == 1)
      return result;
    else
      return result - (traction[1] - pressure * at.profile_slope) * axis;
  }

  /// Its parts on the coordinates (displacement of the point along xi, eta and, in space, zeta, theta, x, tilt, skew).
  template <int dim, class N, class A>
  SPRAG_PART Several<N, dim + 4> generalised(const CylinderPose<N, A> &pose, const Triple<N> &point, const Triple<N> &from_centre,
                                             const Triple<N> &force)
  {
    const auto lever_force = in_lever(pose, force);
    Several<N, dim + 4> result{ { lever_force.x, lever_force.y } };
    if constexpr (dim == 3)
      result[2] = lever_force.z;
    result[dim]     = lever_force.y * point.x - lever_force.x * point.y;
    result[dim + 1] = -force.x;
    for (int i = 0; i < 2; ++i)
      result[dim + 2 + i] = dot(force, pose.axes.axis) * dot(pose.by_slope[i].axis, from_centre) +
                            dot(force, pose.axes.right) * dot(pose.by_slope[i].right, from_centre) +
                            dot(force, pose.axes.upward) * dot(pose.by_slope[i].upward, from_centre);
    return result;
  }

  /// The pose in numbers whose variables from `dim` on are theta, x and the slopes, which go there at a rate; slopes that do not
  /// vary are plain.
  template <int dim, int n, int slopes>
  auto varied_pose(const RigidCylinder &cylinder, const RigidCylinder::Pose &pose, const double rate = 1.)
  {
    using N                = Dual<double, n>;
    const auto make_varied = [&](const auto &tilt, const auto &skew, const auto &number)
    {
      const auto turned = cylinder_pose(0., 0., tilt, skew);
      return CylinderPose<N, decltype(number(tilt))>{ variable<N>(pose.x, dim + 1, rate),
                                                      cosine(variable<N>(pose.theta, dim, rate)),
                                                      sine(variable<N>(pose.theta, dim, rate)),
                                                      turned.axes.each(number),
                                                      { turned.by_slope[0].each(number), turned.by_slope[1].each(number) } };
    };
    const double tilt = cylinder.slopes[0] + pose.turned[0], skew = cylinder.slopes[1] + pose.turned[1];
    if constexpr (slopes == 0)
      return make_varied(tilt, skew, [](const double a) { return a; });
    else
    {
      using Slope = Dual<double, 2>;
      return make_varied(variable<Slope>(tilt, 0, rate), variable<Slope>(skew, 1, rate),
                         [](const Slope &a)
                         {
                           N result;
                           result.v          = a.v;
                           result.d[dim + 2] = a.d[0];
                           result.d[dim + 3] = a.d[1];
                           return result;
                         });
    }
  }

  /// A place in numbers whose first variables are its coordinates.
  template <int dim, class N>
  SPRAG_PART Triple<N> varied_place(const Triple<Plain<N>> &place)
  {
    Triple<N> result{ N{} + place.x, N{} + place.y, N{} + place.z };
    result.x.d[0] = result.y.d[1] = Plain<N>{} + 1.;
    if constexpr (dim == 3)
      result.z.d[2] = Plain<N>{} + 1.;
    return result;
  }
} // namespace sprag
