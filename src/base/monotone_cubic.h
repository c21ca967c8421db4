#pragma once

#include <memory>
#include <vector>

namespace sprag
{
  /// y over x through given points: the monotone cubic of Fritsch and Butland (PCHIP), which never overshoots the points.
  /// Constant beyond its ends.
  class MonotoneCubic
  {
  public:
    /// At least 4 points, all finite, `x` strictly increasing. Throws InputError naming the row otherwise.
    MonotoneCubic(const std::vector<double> &x, const std::vector<double> &y);

    double value(double x) const;

    /// dy/dx; 0 beyond the ends.
    double derivative(double x) const;

  private:
    class Interpolant;
    std::shared_ptr<const Interpolant> interpolant;
    double first;
    double last;
  };
} // namespace sprag
