// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "verification/solid_block.h"

namespace sprag
{
  /// A pressure p0 sqrt(1 - (r/a)^2) on a half-space.
  struct HertzPressure
  {
    double a;       ///< [mm]
    double p0;      ///< [MPa]
    double modulus; ///< E / (1 - nu^2) [MPa]

    /// Displacement of its surface along the pressure, r >= a (Johnson, Contact mechanics, 1985, 3.42).
    double displacement(const double r) const
    {
      return p0 / (2. * a * modulus) * ((2. * a * a - r * r) * std::asin(a / r) + r * a * std::sqrt(1. - a * a / (r * r)));
    }
  };

  /// Hertz' contact of a rigid ball.
  inline HertzPressure hertz_ball(const double P, const double R, const double modulus)
  {
    const double a = std::cbrt(0.75 * P * R / modulus);
    return { a, 1.5 * P / (M_PI * a * a), modulus };
  }

  /// Returns the mean deficit of a block's displacement against a half-space's at a distance from the origin [mm]: the block
  /// ends.
  template <class Displacement>
  double missing(const RubbedBlock &rubbed, const Displacement &half_space_displacement, const RubbedBlock::Vector &direction,
                 const double distance)
  {
    double sum = 0., nodes = 0.;
    for (const auto &[place, moved] : rubbed.displacements())
      if (const double r = std::hypot(place[0], place[2]); std::abs(r - distance) < 0.25 * distance)
      {
        sum += half_space_displacement(RubbedBlock::Vector(place)) - moved * direction;
        nodes += 1.;
      }
    EXPECT_GT(nodes, 0.);
    return sum / nodes;
  }

  /// A number found with two penalties, the second so many times the first, as it is without what falls as 1 / penalty.
  inline double without_penalty(const std::vector<double> &found, const double ratio)
  {
    return found[1] + (found[1] - found[0]) / (ratio - 1.);
  }
} // namespace sprag
