// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include <array>
#include <limits>
#include <vector>

namespace sprag
{
  /// The data that a pressure is fitted to: points along a face or means over some of them.
  struct PressureData
  {
    std::vector<double> xi;       ///< [mm]
    std::vector<double> weight;   ///< area [mm^2]
    std::vector<double> pressure; ///< [MPa]
    std::vector<double> trust;    ///< weight in the misfit [mm^2]
    double size = 0.;             ///< misfit of no pressure
  };

  /// p = (1 + s)^m (1 - s)^n (c_0 + c_1 T_1(s) + ...) with Chebyshev polynomials, s from -1 at a to 1 at b; none elsewhere.
  struct PressureFit
  {
    static constexpr unsigned int largest_degree = 16;
    using Coefficients                           = std::array<double, largest_degree + 1>;

    struct Exponents
    {
      double left, right;
    };

    double a = 0., b = 0.; ///< [mm]
    Exponents exponents{ 0.5, 0.5 };
    unsigned int degree = 2;
    Coefficients c{};
    double misfit = std::numeric_limits<double>::infinity(); ///< sum of its squares, weighted with trust

    double pressure(double xi) const;
  };

  /// Sets the coefficients of least misfit among those that keep resultant and moment of the data, and the misfit; infinite if
  /// the data do not tell the coefficients.
  void set_coefficients(const PressureData &data, PressureFit &fit);
} // namespace sprag
