// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "laws/point_law.h"
#include "model/step/contact_point.h"
#include "scene/lever.h"

#include <functional>

namespace sprag
{
  // Lever axes: xi along d = (-cos th, sin th) away from the pivot, eta along n = (sin th, cos th) from cylinder to lever.

  /// A point in lever axes [mm].
  struct LeverPoint
  {
    double xi;
    double eta;
  };

  /// The circle in lever axes, for many points.
  template <class N>
  struct PlacedCircle
  {
    double radius;
    N xi, eta; ///< centre [mm]
    N theta, sine, cosine;
  };

  /// Returns the circle with centre (xi, eta) = (a cos th - h sin th, -a sin th - h cos th), a = l - x [mm].
  template <class N>
  PlacedCircle<N> placed_circle(const Geometry &geometry, const N &x, const N &theta)
  {
    const N a = geometry.pivot_distance - x, s = sine(theta), c = cosine(theta);
    const double h = geometry.pivot_height;
    return { geometry.cylinder_radius, a * c - h * s, -(a * s + h * c), theta, s, c };
  }

  /// Centre (x, 0) of the cylinder in lever axes [mm].
  inline LeverPoint cylinder_centre(const Geometry &geometry, const double x, const double theta)
  {
    const auto circle = placed_circle(geometry, x, theta);
    return { circle.xi, circle.eta };
  }

  /// Returns that centre as a function of x [mm] and theta [rad].
  inline std::function<LeverPoint(double x, double theta)> cylinder_centre(const Geometry &geometry)
  {
    return [geometry](const double x, const double theta) { return cylinder_centre(geometry, x, theta); };
  }

  /// A point of the lever against the rigid circle, which does not rotate. Rows are derivatives by the displacement of the point
  /// along xi and eta, rotation theta, position x of the circle: minus the force on x is the x-force of the circle on the lever.
  template <class N>
  struct PointOnCircle
  {
    N gap, slip; ///< [mm]
    Several<N, 4> gap_row, slip_row;
  };

  /// With r the vector from centre to point and beta its angle from eta towards xi:
  ///   gap = |r| - R,   slip = R (beta - theta),
  /// the arc along which the circle has passed the point, so large sliding and large rotation are exact.
  template <class N>
  PointOnCircle<N> on_circle(const PlacedCircle<N> &circle, const N &xi, const N &eta)
  {
    const N r_1 = xi - circle.xi, r_2 = eta - circle.eta;
    const N r        = square_root(r_1 * r_1 + r_2 * r_2);
    const N inverse  = 1. / r;
    const N sin_beta = r_1 * inverse, cos_beta = r_2 * inverse, arc = circle.radius * inverse;
    // The centre moves by (eta, -xi) of its own as theta grows, by (-cos theta, sin theta) as x does.
    return { r - circle.radius,
             circle.radius * (angle_between(1., 0., r_2, r_1) - circle.theta),
             { { sin_beta, cos_beta, cos_beta * circle.xi - sin_beta * circle.eta,
                 sin_beta * circle.cosine - cos_beta * circle.sine } },
             { { arc * cos_beta, -(arc * sin_beta), -(arc * (cos_beta * circle.eta + sin_beta * circle.xi)) - circle.radius,
                 arc * (cos_beta * circle.cosine + sin_beta * circle.sine) } } };
  }
} // namespace sprag
