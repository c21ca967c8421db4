// SPDX-License-Identifier: GPL-3.0-only
#include "model/contact/circle.h"

namespace sprag
{
  LeverPoint cylinder_centre(const Geometry &geometry, const double x, const double theta)
  {
    const auto circle = placed_circle(geometry, x, theta);
    return { circle.xi, circle.eta };
  }

  std::function<LeverPoint(double x, double theta)> cylinder_centre(const Geometry &geometry)
  {
    return [geometry](const double x, const double theta) { return cylinder_centre(geometry, x, theta); };
  }
} // namespace sprag
