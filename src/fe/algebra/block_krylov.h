// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "base/krylov_size.h"

#include <deal.II/lac/vector.h>

#include <functional>
#include <vector>

namespace sprag
{
  /// The pencil K phi = lambda M phi of symmetric positive definite matrices, by products with columns of `size` numbers, one
  /// after another.
  struct Pencil
  {
    using Product = std::function<std::vector<double>(std::vector<double> columns)>;

    std::size_t size;
    Product inverse_stiffness; ///< K^-1
    Product mass;              ///< M
  };

  /// An eigenpair (lambda, phi) of a pencil, phi^T M phi = 1.
  struct NormalMode
  {
    double value;
    std::vector<double> vector; ///< of mass 1
  };

  /// Returns a product with columns by that with one.
  Pencil::Product column_by_column(std::size_t size,
                                   std::function<dealii::Vector<double>(const dealii::Vector<double> &)> product);

  /// Returns the `n_modes` pairs of the lowest eigenvalues, or all if there are not so many, increasing. The last number of a
  /// mode is positive, or where that hardly moves, the first of the largest ones.
  ///
  /// The Krylov space of K^-1 M grows by a block of four columns at a time (block Lanczos with full orthogonalisation, Golub &
  /// Van Loan, Matrix Computations, section 10.3.6): factors of a large K have to pass through memory for each solve, so that one
  /// with four columns takes 1.4 times as long as with one. When it has some four times as many columns as are wanted, the best
  /// go on alone (thick restart, Wu & Simon 2000). It begins with the same columns each time. Converged where a pair's residual
  /// |K^-1 M phi - phi/lambda| is below 1e-13/lambda by what the space tells, or round-off. Of a pencil that is hardly larger
  /// than the space LAPACK finds all pairs. Throws AnalysisError where a hundred restarts do not find them or residuals are too
  /// large.
  std::vector<NormalMode> normal_modes(const Pencil &pencil, unsigned int n_modes);
} // namespace sprag
