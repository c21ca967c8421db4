// SPDX-License-Identifier: GPL-3.0-only
#include "fe/contact/element_travel.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sprag
{
  template <int dim>
  ElementTravel<dim>::ElementTravel(const double farthest_, const double most_shapes_)
      : farthest(farthest_)
      , most_shapes(most_shapes_)
  {
  }

  /// A gap is a distance from the axis, which changes by no more than the point moves past the cylinder, and the profile, which
  /// changes by its slope times the part of that along the axis.
  template <int dim>
  void ElementTravel<dim>::go_to(const Nodal &displacement, const RigidCylinder::Pose &pose, const RigidCylinder::Shape &cylinder)
  {
    const dealii::Tensor<1, 3> axis({ pose.axes.axis.x, pose.axes.axis.y, pose.axes.axis.z });
    if (last)
    {
      double in_plane = 0., sideways = 0., displaced = 0.; // of nodes, the first and the last one squared
      double all = 0.;                                     // which no comparison hides
      for (unsigned int i = 0; i < displacement.size(); i += dim)
      {
        const double *const to = &displacement[i], *const from = &last->displacement[i];
        in_plane            = std::max(in_plane, (to[0] - from[0]) * (to[0] - from[0]) + (to[1] - from[1]) * (to[1] - from[1]));
        sideways            = std::max(sideways, dim == 3 ? std::abs(to[dim - 1] - from[dim - 1]) : 0.);
        const double square = to[0] * to[0] + to[1] * to[1] + (dim == 3 ? to[dim - 1] * to[dim - 1] : 0.);
        displaced           = std::max(displaced, square);
        all += square;
      }
      const double from_pivot = farthest + most_shapes * std::sqrt(displaced);
      const double across =
          most_shapes * std::sqrt(in_plane) + std::abs(pose.theta - last->theta) * from_pivot + std::abs(pose.x - last->x);
      const double from_centre =
          from_pivot + std::abs(cylinder.pivot_distance - pose.x) + std::abs(cylinder.pivot_height) + std::abs(cylinder.position);
      const double turned = (axis - last->axis).norm() * from_centre;
      const double along  = most_shapes * sideways + std::hypot(axis[0], axis[1]) * across + turned;
      sum += across + most_shapes * sideways + 2. * turned + cylinder.largest_slope(from_centre) * along;
      // Beyond this, or where nodes are nowhere, short ways would be lost in round-off.
      constexpr double longest = 1e6;
      if (!(sum < longest) || !std::isfinite(all))
        sum = std::numeric_limits<double>::infinity();
    }
    last = { displacement, pose.x, pose.theta, axis };
  }

  template class ElementTravel<2>;
  template class ElementTravel<3>;
} // namespace sprag
