#include "fe/algebra/compressed_rows.h"

#include "fe/algebra/matrix_rows.h"

namespace sprag
{
  CompressedRows::CompressedRows(const dealii::PETScWrappers::SparseMatrix &matrix)
  {
    const MatrixRows rows(matrix);
    const MatrixValues entries(matrix);
    row_begin.push_back(0);
    for (PetscInt i = 0; i < rows.n; ++i)
    {
      for (PetscInt a = rows.begin[i]; a < rows.begin[i + 1]; ++a)
        if (const double entry = entries[static_cast<std::size_t>(a)]; entry != 0.)
        {
          columns.push_back(static_cast<unsigned int>(rows.column[a]));
          values.push_back(entry);
        }
      row_begin.push_back(static_cast<unsigned int>(columns.size()));
    }
  }
} // namespace sprag
