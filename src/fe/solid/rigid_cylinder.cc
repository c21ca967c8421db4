#include "fe/solid/rigid_cylinder.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sprag
{
  using dealii::Point;
  using dealii::Tensor;

  namespace
  {
    double half_length_of(const Cylinder &cylinder)
    {
      return cylinder.length > 0. ? 0.5 * cylinder.length : std::numeric_limits<double>::infinity();
    }

    constexpr unsigned int first_slope = FixedSurfaceKinematics::n; ///< tilt among the coordinates; skew follows

    /// Derivatives of a place by the coordinates.
    template <int n>
    using Motions = std::array<Tensor<1, 3>, n>;

    /// J^T v.
    template <std::size_t n>
    Tensor<1, n> row(const std::array<Tensor<1, 3>, n> &by_coordinate, const Tensor<1, 3> &vector)
    {
      Tensor<1, n> result;
      for (unsigned int i = 0; i < n; ++i)
        result[i] = by_coordinate[i] * vector;
      return result;
    }

    /// Adds a gradient times the second derivatives of a place by the slopes and all coordinates, as the cylinder sees it.
    void add_turn(const CylinderAxes &axes, const Motions<SurfaceKinematics::n> &by, const Tensor<1, 3> &from_centre,
                  const Tensor<1, 3> &gradient, SurfaceKinematics::Curvature &curvature)
    {
      for (unsigned int i = 0; i < 2; ++i)
      {
        const unsigned int slope = first_slope + i;
        const auto turned        = gradient * axes.turn[i];
        for (unsigned int q = 0; q < first_slope; ++q)
        {
          curvature[slope][q] += turned * by[q];
          curvature[q][slope] += turned * by[q];
        }
        for (unsigned int j = 0; j < 2; ++j)
          curvature[slope][first_slope + j] += gradient * (axes.bend[i][j] * from_centre);
      }
    }
  } // namespace

  RigidCylinder::RigidCylinder(const Geometry &geometry_, const Cylinder &cylinder)
      : geometry(geometry_)
      , half_length(half_length_of(cylinder))
      , position(cylinder.position)
      , edge_radius(cylinder.edge_radius)
      , crown(cylinder.crown_radius > 0. ? 1. / cylinder.crown_radius : 0.)
      , at_rest{ { cylinder.tilt, cylinder.skew } }
      , is_free(cylinder.has_free_axis())
      , axes_at_rest(at_rest)
  {
  }

  RigidCylinder::Pose RigidCylinder::pose(const double x, const double theta, const AxisSlopes &turned) const
  {
    const AxisSlopes slopes{ { at_rest[0] + turned[0], at_rest[1] + turned[1] } };
    return { x, theta, turned, std::cos(theta), std::sin(theta), slopes == at_rest ? axes_at_rest : CylinderAxes(slopes) };
  }

  double RigidCylinder::Shape::largest_slope(const double distance) const
  {
    const double of_rounding = last_of_rounding / std::sqrt(1. - last_of_rounding * last_of_rounding);
    return std::abs(crown) * distance + (edge_radius > 0. ? of_rounding : 0.);
  }

  RigidCylinder::Shape RigidCylinder::shape() const
  {
    return {
      geometry.pivot_distance, geometry.pivot_height, geometry.cylinder_radius, half_length, position, edge_radius, crown
    };
  }

  /// The world's axes are x, y (from the x-axis to the lever) and z (along zeta).
  RigidCylinder::Place RigidCylinder::place_of(const Pose &pose, const Point<3> &point) const
  {
    const Vector from_centre({ geometry.pivot_distance - pose.x - point[0] * pose.cosine + point[1] * pose.sine,
                               geometry.pivot_height + point[0] * pose.sine + point[1] * pose.cosine, point[2] - position });
    const Vector &axis  = pose.axes.axis;
    const double along  = from_centre * axis;
    const Vector across = from_centre - along * axis;
    return { from_centre, along, across, across.norm() };
  }

  RigidCylinder::Profile RigidCylinder::profile(const double along) const
  {
    Profile result{ 0.5 * crown * along * along, crown * along, crown };
    const double into_rounding = std::abs(along) - (half_length - edge_radius);
    if (edge_radius == 0. || into_rounding <= 0.)
      return result;
    const double share = std::min(into_rounding / edge_radius, Shape::last_of_rounding);
    const double root  = std::sqrt(1. - share * share);
    result.value += edge_radius * (1. - root);
    result.slope += std::copysign(share / root, along);
    result.curvature += 1. / (edge_radius * root * root * root);
    return result;
  }

  double RigidCylinder::beyond_ends(const double along) const
  {
    return std::abs(along) - half_length;
  }

  Point<3> RigidCylinder::on_axis(const double along) const
  {
    return Point<3>(0., 0., position) + along * axes_at_rest.axis;
  }

  Point<3> RigidCylinder::on_surface(const double along, const double angle) const
  {
    const double radius = geometry.cylinder_radius - profile(along).value;
    return on_axis(along) + radius * (std::cos(angle) * axes_at_rest.right + std::sin(angle) * axes_at_rest.upward);
  }

  double RigidCylinder::gap(const Pose &pose, const Point<3> &point) const
  {
    const auto at = place_of(pose, point);
    return std::max(at.radius - geometry.cylinder_radius + profile(at.along).value, beyond_ends(at.along));
  }

  std::pair<double, Tensor<1, 3>> RigidCylinder::gap_and_gradient(const Pose &pose, const Point<3> &point) const
  {
    const auto at         = place_of(pose, point);
    const auto shape      = profile(at.along);
    const Vector &axis    = pose.axes.axis;
    const double gap      = at.radius - geometry.cylinder_radius + shape.value;
    const double beyond   = beyond_ends(at.along);
    const bool is_beyond  = beyond > gap;
    const Vector gradient = is_beyond ? std::copysign(1., at.along) * axis : at.across / at.radius + shape.slope * axis;
    const double c        = pose.cosine;
    const double s        = pose.sine;
    const auto in_lever   = Vector({ -gradient[0] * c + gradient[1] * s, gradient[0] * s + gradient[1] * c, gradient[2] });
    return { is_beyond ? beyond : gap, in_lever };
  }

  std::array<double, 2> RigidCylinder::slips(const Pose &pose, const Point<3> &point) const
  {
    return slips_of(pose, place_of(pose, point));
  }

  std::array<double, 2> RigidCylinder::slips_of(const Pose &pose, const Place &place) const
  {
    return { { geometry.cylinder_radius * std::atan2(-(place.across * pose.axes.right), place.across * pose.axes.upward),
               place.along } };
  }

  template <int n>
  SurfaceKinematicsIn<n> RigidCylinder::kinematics(const Pose &pose, const Point<3> &point) const
  {
    const auto at       = place_of(pose, point);
    const auto shape    = profile(at.along);
    const double R      = geometry.cylinder_radius;
    const Vector &axis  = pose.axes.axis;
    const Vector normal = at.across / at.radius;
    const Vector round  = cross_product_3d(axis, normal); // the way the angle about the axis grows

    // The place as the cylinder sees it by the coordinates. Its second derivatives are not zero by theta and a displacement, by
    // theta alone, and by the slopes.
    const double c = pose.cosine, s = pose.sine;
    Motions<n> by{ { Vector({ -c, s, 0. }), Vector({ s, c, 0. }), Vector({ 0., 0., 1. }),
                     Vector({ point[0] * s + point[1] * c, point[0] * c - point[1] * s, 0. }), Vector({ -1., 0., 0. }) } };
    for (unsigned int i = first_slope; i < n; ++i)
      by[i] = pose.axes.turn[i - first_slope] * at.from_centre;
    const Vector by_theta_xi({ s, c, 0. }), by_theta_eta({ c, -s, 0. });
    const Vector by_theta_theta({ point[0] * c - point[1] * s, -point[0] * s - point[1] * c, 0. });
    const auto bend = [&](const Vector &gradient, typename SurfaceKinematicsIn<n>::Curvature &curvature)
    {
      curvature[0][3] += gradient * by_theta_xi;
      curvature[3][0] += gradient * by_theta_xi;
      curvature[1][3] += gradient * by_theta_eta;
      curvature[3][1] += gradient * by_theta_eta;
      curvature[3][3] += gradient * by_theta_theta;
      if constexpr (n > first_slope)
        add_turn(pose.axes, by, at.from_centre, gradient, curvature);
    };

    SurfaceKinematicsIn<n> result;
    const Vector gap_gradient = normal + shape.slope * axis;
    const auto along_normal = row(by, normal), along_round = row(by, round), along_axis = row(by, axis);
    result.gap     = std::max(at.radius - R + shape.value, beyond_ends(at.along));
    result.gap_row = along_normal + shape.slope * along_axis;
    result.gap_curvature =
        outer_product(along_round, along_round) / at.radius + shape.curvature * outer_product(along_axis, along_axis);
    bend(gap_gradient, result.gap_curvature);

    result.slip     = slips_of(pose, at);
    result.slip_row = { { R / at.radius * along_round, along_axis } };
    result.slip_curvature[0] =
        -R / (at.radius * at.radius) * (outer_product(along_normal, along_round) + outer_product(along_round, along_normal));
    bend(R / at.radius * round, result.slip_curvature[0]);
    bend(axis, result.slip_curvature[1]);
    return result;
  }

  template SurfaceKinematics RigidCylinder::kinematics(const Pose &, const Point<3> &) const;
  template FixedSurfaceKinematics RigidCylinder::kinematics(const Pose &, const Point<3> &) const;
} // namespace sprag
