// SPDX-License-Identifier: GPL-3.0-only
#include "model/circle.h"

#include <cmath>

namespace sprag
{
  using dealii::Tensor;

  LeverPoint cylinder_centre(const Geometry &geometry, const double x, const double theta)
  {
    const double a = geometry.pivot_distance - x;
    const double h = geometry.pivot_height;
    return { a * std::cos(theta) - h * std::sin(theta), -a * std::sin(theta) - h * std::cos(theta) };
  }

  PlacedCircle placed_circle(const Geometry &geometry, const double x, const double theta)
  {
    return { geometry.cylinder_radius, cylinder_centre(geometry, x, theta), theta, std::sin(theta), std::cos(theta) };
  }

  ContactKinematics<4> moving_circle_contact(const Geometry &geometry, const LeverPoint &point, const double x,
                                             const double theta)
  {
    return moving_circle_contact(placed_circle(geometry, x, theta), point);
  }

  ContactKinematics<4> moving_circle_contact(const PlacedCircle &circle, const LeverPoint &point)
  {
    const double R     = circle.radius;
    const LeverPoint c = circle.centre;
    const double r_1   = point.xi - c.xi;
    const double r_2   = point.eta - c.eta;
    const double r     = std::sqrt(r_1 * r_1 + r_2 * r_2);

    // N = (sin beta, cos beta), T = (cos beta, -sin beta), as rows over (u_xi, u_eta, theta, x); dc/dtheta = (c_2, -c_1),
    // dc/dx = (-cos theta, sin theta).
    const double sin_beta = r_1 / r;
    const double cos_beta = r_2 / r;
    const double along_x  = cos_beta * circle.cosine + sin_beta * circle.sine;
    const double across_x = sin_beta * circle.cosine - cos_beta * circle.sine;
    Tensor<1, 4> normal({ sin_beta, cos_beta, -sin_beta * c.eta + cos_beta * c.xi, across_x });
    Tensor<1, 4> tangential({ cos_beta, -sin_beta, -cos_beta * c.eta - sin_beta * c.xi, along_x });
    Tensor<1, 4> rotation({ 0., 0., 1., 0. });
    ContactKinematics<4> result;

    result.gap           = r - R;
    result.gap_row       = normal;
    const double inverse = 1. / r, of_slip = -R / (r * r);
    for (unsigned int i = 0; i < 4; ++i)
      for (unsigned int j = i; j < 4; ++j)
      {
        const double both          = normal[i] * tangential[j] + tangential[i] * normal[j];
        result.gap_curvature[i][j] = result.gap_curvature[j][i] = tangential[i] * tangential[j] * inverse;
        result.slip_curvature[i][j] = result.slip_curvature[j][i] = of_slip * both;
      }

    result.gap_curvature[2][2] += sin_beta * c.xi + cos_beta * c.eta;
    result.gap_curvature[2][3] -= along_x;
    result.gap_curvature[3][2] -= along_x;

    result.slip     = R * (std::atan2(r_1, r_2) - circle.theta);
    result.slip_row = R * (tangential / r - rotation);
    result.slip_curvature[2][2] += R / r * (cos_beta * c.xi - sin_beta * c.eta);
    result.slip_curvature[2][3] += R / r * across_x;
    result.slip_curvature[3][2] += R / r * across_x;
    return result;
  }
} // namespace sprag
