#pragma once

#include "base/lanes.h"
#include "fe/solid/rigid_cylinder.h"

namespace sprag
{
  /// Three coordinates of eight points.
  struct PointsInLanes
  {
    Lanes x, y, z;
  };

  SPRAG_PART PointsInLanes operator+(const PointsInLanes &a, const PointsInLanes &b)
  {
    return { a.x + b.x, a.y + b.y, a.z + b.z };
  }

  SPRAG_PART PointsInLanes operator-(const PointsInLanes &a, const PointsInLanes &b)
  {
    return { a.x - b.x, a.y - b.y, a.z - b.z };
  }

  SPRAG_PART PointsInLanes operator*(const Lanes &factor, const PointsInLanes &a)
  {
    return { factor * a.x, factor * a.y, factor * a.z };
  }

  SPRAG_PART PointsInLanes operator*(const double factor, const PointsInLanes &a)
  {
    return { factor * a.x, factor * a.y, factor * a.z };
  }

  SPRAG_PART Lanes dot(const PointsInLanes &a, const PointsInLanes &b)
  {
    return a.x * b.x + a.y * b.y + a.z * b.z;
  }

  SPRAG_PART Lanes dot(const PointsInLanes &a, const dealii::Tensor<1, 3> &b)
  {
    return a.x * b[0] + a.y * b[1] + a.z * b[2];
  }

  SPRAG_PART PointsInLanes times(const Lanes &factor, const dealii::Tensor<1, 3> &a)
  {
    return { factor * a[0], factor * a[1], factor * a[2] };
  }

  SPRAG_PART PointsInLanes times(const dealii::Tensor<2, 3> &matrix, const PointsInLanes &a)
  {
    return { dot(a, matrix[0]), dot(a, matrix[1]), dot(a, matrix[2]) };
  }

  SPRAG_PART PointsInLanes transposed_times(const dealii::Tensor<2, 3> &matrix, const PointsInLanes &a)
  {
    return times(a.x, matrix[0]) + times(a.y, matrix[1]) + times(a.z, matrix[2]);
  }

  SPRAG_PART PointsInLanes cross(const dealii::Tensor<1, 3> &a, const PointsInLanes &b)
  {
    return { a[1] * b.z - a[2] * b.y, a[2] * b.x - a[0] * b.z, a[0] * b.y - a[1] * b.x };
  }

  /// Eight points of the lever as the cylinder sees them, see RigidCylinder: in the axes of the world.
  struct PlacesInLanes
  {
    PointsInLanes from_centre;
    Lanes along; ///< s [mm]
    PointsInLanes normal;
    Lanes radius; ///< off the axis
    Lanes gap;
    Lanes profile_slope, profile_curvature;
  };

  SPRAG_PART PlacesInLanes places_of(const RigidCylinder::Shape &cylinder, const RigidCylinder::Pose &pose,
                                     const PointsInLanes &point)
  {
    const double c = pose.cosine, s = pose.sine;
    PlacesInLanes result;
    result.from_centre         = { cylinder.pivot_distance - pose.x - c * point.x + s * point.y,
                                   cylinder.pivot_height + s * point.x + c * point.y, point.z - cylinder.position };
    result.along               = dot(result.from_centre, pose.axes.axis);
    const PointsInLanes across = result.from_centre - times(result.along, pose.axes.axis);
    result.radius              = square_root(dot(across, across));
    result.normal              = (1. / result.radius) * across;

    Lanes profile            = 0.5 * cylinder.crown * result.along * result.along;
    result.profile_slope     = cylinder.crown * result.along;
    result.profile_curvature = all_lanes(cylinder.crown);
    const Lanes from_middle  = absolute(result.along);
    if (cylinder.edge_radius > 0.)
    {
      const double edge     = cylinder.edge_radius;
      const Lanes into      = from_middle - (cylinder.half_length - edge);
      const LaneMask inside = into > 0.;
      const Lanes share     = smaller(into / edge, all_lanes(RigidCylinder::Shape::last_of_rounding));
      const Lanes root      = square_root(1. - (inside ? share * share : Lanes{}));
      const Lanes slope     = share / root;
      profile += inside ? edge * (1. - root) : Lanes{};
      result.profile_slope += inside ? (result.along < 0. ? -slope : slope) : Lanes{};
      result.profile_curvature += inside ? 1. / (edge * root * root * root) : Lanes{};
    }
    result.gap = larger(result.radius - cylinder.radius + profile, from_middle - cylinder.half_length);
    return result;
  }
} // namespace sprag
