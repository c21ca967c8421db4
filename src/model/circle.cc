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

  ContactKinematics<3> circle_contact(const Geometry &geometry, const LeverPoint &point, const double x, const double theta)
  {
    const double R     = geometry.cylinder_radius;
    const LeverPoint c = cylinder_centre(geometry, x, theta);
    const double r_1   = point.xi - c.xi;
    const double r_2   = point.eta - c.eta;
    const double r     = std::hypot(r_1, r_2);

    // N = (sin beta, cos beta), T = (cos beta, -sin beta), as rows over (u_xi, u_eta, theta); dc/dtheta = (c_2, -c_1).
    const double sin_beta = r_1 / r;
    const double cos_beta = r_2 / r;
    Tensor<1, 3> normal({ sin_beta, cos_beta, -sin_beta * c.eta + cos_beta * c.xi });
    Tensor<1, 3> tangential({ cos_beta, -sin_beta, -cos_beta * c.eta - sin_beta * c.xi });
    Tensor<1, 3> rotation({ 0., 0., 1. });
    ContactKinematics<3> result;

    result.gap           = r - R;
    result.gap_row       = normal;
    result.gap_curvature = outer_product(tangential, tangential) / r;
    result.gap_curvature[2][2] += sin_beta * c.xi + cos_beta * c.eta;

    result.slip           = R * (std::atan2(r_1, r_2) - theta);
    result.slip_row       = R * (tangential / r - rotation);
    result.slip_curvature = -R / (r * r) * (outer_product(normal, tangential) + outer_product(tangential, normal));
    result.slip_curvature[2][2] += R / r * (cos_beta * c.xi - sin_beta * c.eta);
    return result;
  }
} // namespace sprag
