// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "fe/algebra/matrix_rows.h"

#include <deal.II/lac/vector.h>

#include <array>
#include <vector>

namespace sprag
{
  /// A sparse matrix for many products: several vectors in one pass over it.
  class CompressedRows
  {
  public:
    /// Copies the matrix; entries that are 0 are left out.
    explicit CompressedRows(const dealii::PETScWrappers::SparseMatrix &matrix)
    {
      const MatrixRows rows(matrix);
      row_begin.push_back(0);
      for (PetscInt i = 0; i < rows.n; ++i)
      {
        for (PetscInt a = rows.begin[i]; a < rows.begin[i + 1]; ++a)
          if (const double entry = rows[static_cast<std::size_t>(a)]; entry != 0.)
          {
            columns.push_back(static_cast<unsigned int>(rows.column[a]));
            values.push_back(entry);
          }
        row_begin.push_back(static_cast<unsigned int>(columns.size()));
      }
    }

    /// Sets results[k] to the matrix times vectors[k]. Vectors may be longer than the matrix, results are left as they are beyond
    /// it.
    template <std::size_t n>
    void multiply(const std::array<const dealii::Vector<double> *, n> &vectors,
                  const std::array<dealii::Vector<double> *, n> &results) const
    {
      for (unsigned int i = 0; i + 1 < row_begin.size(); ++i)
      {
        std::array<double, n> sums{};
        for (unsigned int a = row_begin[i]; a < row_begin[i + 1]; ++a)
          for (std::size_t k = 0; k < n; ++k)
            sums[k] += values[a] * vectors[k]->begin()[columns[a]];
        for (std::size_t k = 0; k < n; ++k)
          results[k]->begin()[i] = sums[k];
      }
    }

    /// Multiplies the matrix by a vector in extended precision, of which sums of large terms that nearly cancel lose little.
    void multiply(const std::vector<long double> &vector, dealii::Vector<double> &result) const
    {
      for (unsigned int i = 0; i + 1 < row_begin.size(); ++i)
      {
        long double sum = 0.;
        for (unsigned int a = row_begin[i]; a < row_begin[i + 1]; ++a)
          sum += values[a] * vector[columns[a]];
        result[i] = static_cast<double>(sum);
      }
    }

  private:
    std::vector<unsigned int> row_begin;
    std::vector<unsigned int> columns;
    std::vector<double> values;
  };
} // namespace sprag
