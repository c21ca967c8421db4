#include "fe/compressed_rows.h"

#include "base/errors.h"

namespace sprag
{
  CompressedRows::CompressedRows(const dealii::PETScWrappers::SparseMatrix &matrix)
  {
    const auto n = static_cast<PetscInt>(matrix.m());
    row_begin.push_back(0);
    for (PetscInt i = 0; i < n; ++i)
    {
      PetscInt length           = 0;
      const PetscInt *indices   = nullptr;
      const PetscScalar *of_row = nullptr;
      if (MatGetRow(matrix, i, &length, &indices, &of_row) != 0)
        throw AnalysisError("a row of a matrix cannot be read");
      for (PetscInt a = 0; a < length; ++a)
        if (of_row[a] != 0.)
        {
          columns.push_back(static_cast<unsigned int>(indices[a]));
          values.push_back(of_row[a]);
        }
      MatRestoreRow(matrix, i, &length, &indices, &of_row);
      row_begin.push_back(static_cast<unsigned int>(columns.size()));
    }
  }
} // namespace sprag
