// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include <deal.II/lac/petsc_sparse_matrix.h>
#include <deal.II/lac/vector.h>

#include <vector>

namespace sprag
{
  /// Modes of undamped vibration, K phi = omega^2 M phi, in increasing order.
  struct FreeModes
  {
    std::vector<double> stiffness;              ///< omega^2 [1/s^2]
    std::vector<dealii::Vector<double>> shapes; ///< phi^T M phi = 1
  };

  /// Finds the lowest `n` modes, or all if there are not so many. Both matrices symmetric and positive definite. Throws
  /// AnalysisError if a residual is too large.
  FreeModes free_modes(const dealii::PETScWrappers::SparseMatrix &stiffness, const dealii::PETScWrappers::SparseMatrix &mass,
                       unsigned int n);
} // namespace sprag
