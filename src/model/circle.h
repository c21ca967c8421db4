// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "model/contact_point.h"
#include "scene/lever.h"

#include <cmath>

namespace sprag
{
  // Lever axes: xi along d = (-cos th, sin th) away from the pivot, eta along n = (sin th, cos th) from cylinder to lever.

  struct LeverPoint
  {
    double xi;
    double eta;
  };

  /// Centre (x, 0) of the cylinder in lever axes [mm].
  LeverPoint cylinder_centre(const Geometry &geometry, double x, double theta);

  /// The circle at a position x and a rotation theta, for many points.
  struct PlacedCircle
  {
    double radius;
    LeverPoint centre;
    double theta;
    double sine; ///< of theta
    double cosine;
  };

  PlacedCircle placed_circle(const Geometry &geometry, double x, double theta);

  /// Returns the gap between a point of the lever and the circle [mm].
  inline double circle_gap(const PlacedCircle &circle, const LeverPoint &point)
  {
    const double r_1 = point.xi - circle.centre.xi;
    const double r_2 = point.eta - circle.centre.eta;
    return std::sqrt(r_1 * r_1 + r_2 * r_2) - circle.radius;
  }

  /// A point of the lever against the rigid circle, which does not rotate. Coordinates: displacement of the point along xi and
  /// eta, rotation theta, position x of the circle: minus the force on x is the x-force of the circle on the lever. With r the
  /// vector from centre to point and beta its angle from eta towards xi:
  ///   gap = |r| - R,   slip = R (beta - theta),
  /// the arc along which the circle has passed the point, so large sliding and large rotation are exact.
  ContactKinematics<4> moving_circle_contact(const PlacedCircle &circle, const LeverPoint &point);
  ContactKinematics<4> moving_circle_contact(const Geometry &geometry, const LeverPoint &point, double x, double theta);
} // namespace sprag
