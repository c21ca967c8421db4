// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include <vector>

namespace sprag
{
  /// A straight line.
  struct Line
  {
    double mean_x;
    double mean_y; ///< at mean_x
    double slope;

    double at(double x) const
    {
      return mean_y + slope * (x - mean_x);
    }
  };

  /// Finds the line of least squares of y over x, which have equally many entries, at least two different x among them. The
  /// weights, all > 0, multiply the squares and count in the means; without them all points count the same.
  Line fitted_line(const std::vector<double> &x, const std::vector<double> &y, const std::vector<double> &weights = {});

  /// Finds the slope at the origin of the parabola of least squares through it, y = slope x + bend x^2, from at least two
  /// different x.
  double slope_at_origin(const std::vector<double> &x, const std::vector<double> &y);

  /// A factor by which a shape meets values.
  struct ScaledShape
  {
    double factor;
    double error; ///< root mean square of what the values are off, over the largest of them
  };

  /// Finds the factor by which `shape` meets values best by least squares; neither is 0 everywhere.
  ScaledShape fitted_factor(const std::vector<double> &shape, const std::vector<double> &values);
} // namespace sprag
