// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include <deal.II/base/tensor.h>

#include <array>
#include <cmath>

namespace sprag
{
  /// Returns the rates of rotation of a cylinder's axes by its slopes, in the axes of the world: psi' e_y - phi' (cos(psi), 0,
  /// -sin(psi)). The yaw psi = atan(skew) is about y, the elevation phi = atan(tilt/sqrt(1 + skew^2)) about the axis across.
  inline std::array<dealii::Tensor<1, 3>, 2> turns_by_slopes(const double tilt, const double skew)
  {
    const double m2 = 1. + skew * skew, m = std::sqrt(m2), psi = std::atan(skew);
    const dealii::Tensor<1, 3> across({ std::cos(psi), 0., -std::sin(psi) }), up({ 0., 1., 0. });
    return { { -m / (m2 + tilt * tilt) * across, up / m2 + tilt * skew / (m * (m2 + tilt * tilt)) * across } };
  }
} // namespace sprag
