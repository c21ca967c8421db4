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

  /// The line of least squares of y over x, which have as many entries, at least two different x among them. Weights > 0 are
  /// those of the squares; without them all count the same. Means are those by the weights.
  Line fitted_line(const std::vector<double> &x, const std::vector<double> &y, const std::vector<double> &weights = {});

  /// The parabola of least squares through the origin, y = slope x + bend x^2, has this slope; of at least two different x.
  double slope_at_origin(const std::vector<double> &x, const std::vector<double> &y);

  /// A factor times a shape.
  struct ScaledShape
  {
    double factor;
    double error; ///< root mean square of what the values are off, over the largest of them
  };

  /// The factor by which `shape` meets values best by least squares; neither is 0 everywhere.
  ScaledShape fitted_factor(const std::vector<double> &shape, const std::vector<double> &values);
} // namespace sprag
