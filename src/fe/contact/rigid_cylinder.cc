// SPDX-License-Identifier: GPL-3.0-only
#include "fe/contact/cylinder_point.h"

#include <limits>

namespace sprag
{
  using dealii::Point;
  using dealii::Tensor;

  namespace
  {
    RigidCylinder::Shape make_shape(const Geometry &geometry, const Cylinder &cylinder)
    {
      return { geometry.pivot_distance,
               geometry.pivot_height,
               geometry.cylinder_radius,
               cylinder.length > 0. ? 0.5 * cylinder.length : std::numeric_limits<double>::infinity(),
               cylinder.position,
               cylinder.edge_radius,
               cylinder.crown_radius > 0. ? 1. / cylinder.crown_radius : 0. };
    }

    Triple<double> to_triple(const Point<3> &point)
    {
      return { point[0], point[1], point[2] };
    }

    Tensor<1, 3> to_tensor(const Triple<double> &a)
    {
      return Tensor<1, 3>({ a.x, a.y, a.z });
    }
  } // namespace

  RigidCylinder::RigidCylinder(const Geometry &geometry, const Cylinder &cylinder)
      : shape(make_shape(geometry, cylinder))
      , slopes{ { cylinder.tilt, cylinder.skew } }
      , has_free_axis(cylinder.has_free_axis())
      , axes_at_rest(cylinder_axes(cylinder.tilt, cylinder.skew))
  {
  }

  RigidCylinder::Pose RigidCylinder::pose(const double x, const double theta, const AxisSlopes &turned) const
  {
    return { cylinder_pose(x, theta, slopes[0] + turned[0], slopes[1] + turned[1]), theta, turned };
  }

  double RigidCylinder::Shape::largest_slope(const double distance) const
  {
    const double rounding_slope = rounding_end / std::sqrt(1. - rounding_end * rounding_end);
    return std::abs(crown) * distance + (edge_radius > 0. ? rounding_slope : 0.);
  }

  Point<3> RigidCylinder::on_axis(const double along) const
  {
    return Point<3>(0., 0., shape.position) + along * to_tensor(axes_at_rest.axis);
  }

  Point<3> RigidCylinder::on_surface(const double along, const double angle) const
  {
    const double radius = shape.radius - profile_at(shape, along).depth;
    return on_axis(along) + radius * to_tensor(std::cos(angle) * axes_at_rest.right + std::sin(angle) * axes_at_rest.upward);
  }

  std::pair<double, Tensor<1, 3>> RigidCylinder::gap_and_gradient(const Pose &pose, const Point<3> &point) const
  {
    using N = Dual<double, 3>;
    const auto gap =
        seen(shape, pose, Triple<N>{ variable<N>(point[0], 0), variable<N>(point[1], 1), variable<N>(point[2], 2) }).gap;
    return { gap.v, Tensor<1, 3>({ gap.d[0], gap.d[1], gap.d[2] }) };
  }

  double RigidCylinder::slip(const Pose &pose, const Point<3> &point) const
  {
    return slip_round(shape, 0., 1., seen(shape, pose, to_triple(point)).from_centre, pose.axes);
  }

  std::array<double, 3> RigidCylinder::changes(const Pose &pose, const Point<3> &point, const Tensor<1, 3> &moved, const double x,
                                               const double theta, const AxisSlopes &turned) const
  {
    using N           = Dual<double, 1>;
    const auto rate   = [](const double at, const double change) { return variable<N>(at, 0, change); };
    const auto moving = cylinder_pose(rate(pose.x, x), rate(pose.theta, theta), rate(slopes[0] + pose.turned[0], turned[0]),
                                      rate(slopes[1] + pose.turned[1], turned[1]));
    const auto at =
        seen(shape, moving, Triple<N>{ rate(point[0], moved[0]), rate(point[1], moved[1]), rate(point[2], moved[2]) });
    return { { at.gap.d[0], slip_round(shape, 0., 1., at.from_centre, moving.axes).d[0], at.along.d[0] } };
  }
} // namespace sprag
