// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include <memory>
#include <vector>

namespace sprag
{
  /// Cubics through given points, y over x, that overshoot none of them. They are constant beyond their ends.
  class MonotoneCubic
  {
  public:
    /// Slopes at the points; 0 where y turns or stays.
    enum class Slopes
    {
      pchip, ///< of Fritsch and Butland: of two secants their weighted harmonic mean
      smooth ///< of polynomials through five points, at most three times the smaller secant: dy/dx of a motion to fourth order
    };

    /// Takes at least 4 points, all finite, with `x` strictly increasing. Throws InputError naming the row otherwise.
    MonotoneCubic(const std::vector<double> &x, const std::vector<double> &y, Slopes slopes = Slopes::pchip);

    double value(double x) const;

    /// Returns dy/dx, which is 0 beyond the ends.
    double derivative(double x) const;

  private:
    struct Interpolant;
    std::shared_ptr<const Interpolant> interpolant;
    double first;
    double last;
  };
} // namespace sprag
