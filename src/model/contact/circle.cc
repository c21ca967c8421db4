// SPDX-License-Identifier: GPL-3.0-only
#include "model/contact/circle.h"

namespace sprag
{
  using N = Dual<double, 4>;

  LeverPoint cylinder_centre(const Geometry &geometry, const double x, const double theta)
  {
    const auto circle = placed_circle(geometry, x, theta);
    return { circle.xi, circle.eta };
  }

  std::function<LeverPoint(double x, double theta)> cylinder_centre(const Geometry &geometry)
  {
    return [geometry](const double x, const double theta) { return cylinder_centre(geometry, x, theta); };
  }

  CircleOfPoints placed_for_points(const Geometry &geometry, const double x, const double theta)
  {
    return placed_circle(geometry, variable<N>(x, 3), variable<N>(theta, 2));
  }

  ContactKinematics<4> moving_circle_contact(const CircleOfPoints &circle, const LeverPoint &point)
  {
    const auto at = on_circle(circle, variable<N>(point.xi, 0), variable<N>(point.eta, 1));
    ContactKinematics<4> result;
    result.gap  = at.gap.v;
    result.slip = at.slip.v;
    for (unsigned int i = 0; i < 4; ++i)
    {
      result.gap_row[i]  = at.gap_row[i].v;
      result.slip_row[i] = at.slip_row[i].v;
      for (unsigned int j = 0; j < 4; ++j)
      {
        result.gap_curvature[i][j]  = at.gap_row[i].d[j];
        result.slip_curvature[i][j] = at.slip_row[i].d[j];
      }
    }
    return result;
  }
} // namespace sprag
