// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/petsc_sparse_matrix.h>
#include <deal.II/lac/vector.h>

#include <petscmat.h>

#include <map>
#include <vector>

namespace sprag
{
  /// Known property of a matrix, by which its factorisation is chosen.
  enum class MatrixKind
  {
    general,           ///< LU
    positive_definite, ///< and symmetric: Cholesky, half of the time and memory
  };

  /// Factors of a sequential PETSc matrix by MUMPS. Every return status is checked: MUMPS fails silently otherwise.
  /// All functions throw AnalysisError, naming the status, when a factorisation or solve fails.
  class Mumps
  {
  public:
    explicit Mumps(MatrixKind kind = MatrixKind::general);
    Mumps &operator=(Mumps &&) = delete;
    ~Mumps();

    /// Factorises; the ordering is kept for matrices of the same pattern.
    void factorise(const dealii::PETScWrappers::SparseMatrix &matrix);

    /// Factorises and returns the Schur complement on `indices`, which stay in that order: the stiffness left on them when all
    /// others are eliminated. Solves with the whole matrix remain possible.
    dealii::FullMatrix<double> factorise_with_schur_complement(const dealii::PETScWrappers::SparseMatrix &matrix,
                                                               const std::vector<unsigned int> &indices);

    void solve(const dealii::Vector<double> &right_hand_side, dealii::Vector<double> &solution) const;

    /// Solves with some columns, one after another.
    std::vector<double> solve(std::vector<double> columns) const;

    /// Finds entries of the inverse of a symmetric matrix, in the order asked for: `wanted` holds increasing columns by their
    /// row. Only the parts of the factors between rows and columns are visited.
    std::vector<double> entries_of_inverse(const std::map<unsigned int, std::vector<unsigned int>> &wanted) const;

  private:
    void check(PetscErrorCode code, const char *what) const;
    void check_factor(const char *what) const;
    void symbolic(const dealii::PETScWrappers::SparseMatrix &matrix);
    void numeric(const dealii::PETScWrappers::SparseMatrix &matrix);

    const MatrixKind kind;
    Mat factor = nullptr;
  };
} // namespace sprag
