// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "base/errors.h"

#include <deal.II/lac/petsc_sparse_matrix.h>

namespace sprag
{
  /// Row beginnings, columns and entries of a sequential matrix; to be destroyed before the matrix changes its pattern. The
  /// entries can be read and changed. Throws AnalysisError where PETSc does not give them.
  class MatrixRows
  {
  public:
    explicit MatrixRows(const dealii::PETScWrappers::SparseMatrix &matrix_)
        : matrix(matrix_)
    {
      PetscBool found = PETSC_FALSE;
      if (MatGetRowIJ(matrix, 0, PETSC_FALSE, PETSC_FALSE, &n, &begin, &column, &found) != 0 || found == PETSC_FALSE ||
          MatSeqAIJGetArray(matrix, &entries) != 0)
        throw AnalysisError("the rows of a matrix cannot be read");
    }
    MatrixRows &operator=(MatrixRows &&) = delete;
    ~MatrixRows()
    {
      PetscBool found = PETSC_FALSE;
      MatSeqAIJRestoreArray(matrix, &entries);
      MatRestoreRowIJ(matrix, 0, PETSC_FALSE, PETSC_FALSE, &n, &begin, &column, &found);
    }

    PetscScalar &operator[](const std::size_t i) const
    {
      return entries[i];
    }

    PetscInt n             = 0;
    const PetscInt *begin  = nullptr;
    const PetscInt *column = nullptr;

  private:
    const Mat matrix;
    PetscScalar *entries = nullptr;
  };
} // namespace sprag
