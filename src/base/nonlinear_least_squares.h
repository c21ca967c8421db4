// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include <functional>
#include <vector>

namespace sprag
{
  /// Residuals, of fixed number, of unknowns that are scaled such that 1 is a large change of each. Where the unknowns make no
  /// sense the residuals are large numbers, never NaN.
  using Residuals = std::function<std::vector<double>(const std::vector<double> &unknowns)>;

  /// Returns d(residual i)/d(unknown j) at i * unknowns + j, by central differences.
  std::vector<double> jacobian(const Residuals &residuals, const std::vector<double> &unknowns);

  /// Finds the least sum of squares near `start` by the method of Levenberg and Marquardt in its trust region (GSL's
  /// multifit_nlinear, with geodesic acceleration off): where no step lessens it any more, or after 200
  /// steps. There are at least as many residuals as unknowns.
  std::vector<double> least_squares(const Residuals &residuals, const std::vector<double> &start);

  /// Singular values, decreasing, and directions of a matrix of few columns.
  struct SingularValues
  {
    std::vector<double> values;
    std::vector<double> left;       ///< row by row, a column each value
    std::vector<double> directions; ///< of the unknowns: component i of direction j at i * columns + j
  };

  /// Decomposes a matrix with at least as many rows as columns, row by row, by one-sided Jacobi rotations, which keep small
  /// values exact.
  SingularValues singular_values(const std::vector<double> &matrix, std::size_t columns);
} // namespace sprag
