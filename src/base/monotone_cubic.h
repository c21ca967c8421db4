// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include <memory>
#include <vector>

namespace sprag
{
  /// The monotone cubic of Fritsch and Butland (PCHIP): y over x through given points, which it never overshoots. It is constant
  /// beyond its ends.
  class MonotoneCubic
  {
  public:
    /// Takes at least 4 points, all finite, with `x` strictly increasing. Throws InputError naming the row otherwise.
    MonotoneCubic(const std::vector<double> &x, const std::vector<double> &y);

    double value(double x) const;

    /// Returns dy/dx, which is 0 beyond the ends.
    double derivative(double x) const;

  private:
    class Interpolant;
    std::shared_ptr<const Interpolant> interpolant;
    double first;
    double last;
  };
} // namespace sprag
