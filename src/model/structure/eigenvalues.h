// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/vector.h>

#include <array>
#include <complex>
#include <vector>

namespace sprag
{
  /// Holds an eigenvalue and its right eigenvector.
  struct Eigenpair
  {
    std::complex<double> value;                   ///< imaginary part >= 0; of a complex pair only the one with the positive one
    std::array<dealii::Vector<double>, 2> vector; ///< real and imaginary part
  };

  /// Finds the right eigenpairs of a real square matrix (LAPACK dgeev). Throws AnalysisError if the iteration fails or the matrix
  /// has an entry that is no number. Without `vectors` these are empty: it takes half the time.
  std::vector<Eigenpair> eigenpairs(const dealii::FullMatrix<double> &matrix, bool vectors = true);
} // namespace sprag
