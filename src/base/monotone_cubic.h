// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include <memory>
#include <vector>

namespace sprag
{
  /// Cubics through given points, y over x, constant beyond their ends.
  class MonotoneCubic
  {
  public:
    /// Slopes at the points.
    enum class Slopes
    {
      pchip, ///< of Fritsch and Butland: of two secants their weighted harmonic mean, 0 where y turns or stays
      smooth ///< of polynomials through five points: dy/dx of a motion to fourth order, which turns between points where it bends
             ///< alike on both sides; elsewhere none is overshot
    };

    /// Takes at least 4 points, all finite, with `x` strictly increasing. Throws InputError naming the row otherwise.
    MonotoneCubic(const std::vector<double> &x, const std::vector<double> &y, Slopes slopes = Slopes::pchip);

    double value(double x) const;

    /// Returns dy/dx, which is 0 beyond the ends.
    double derivative(double x) const;

  private:
    std::function<double(double)> value_inside, slope_inside;
    double first;
    double last;
  };
} // namespace sprag
