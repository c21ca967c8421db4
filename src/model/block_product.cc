#include "model/block_product.h"

#include <deal.II/lac/lapack_templates.h>

namespace sprag
{
  void add_block_product(const dealii::FullMatrix<double> &symmetric, const NumberRange &rows, const NumberRange &columns,
                         const double *const values, double *const result)
  {
    constexpr unsigned int few = 512; // entries that are summed in less time than a call of a library takes
    if (rows.size() * columns.size() < few)
    {
      for (unsigned int j = columns.begin; j < columns.end; ++j)
      {
        const double *const column = &symmetric(j, 0); // as it is symmetric
        const double value         = values[j - columns.begin];
        for (unsigned int i = rows.begin; i < rows.end; ++i)
          result[i - rows.begin] += column[i] * value;
      }
      return;
    }
    using Int        = dealii::types::blas_int;
    const double one = 1.;
    const Int m = static_cast<Int>(rows.size()), n = static_cast<Int>(columns.size());
    const Int stride = static_cast<Int>(symmetric.n()), next = 1;
    gemv("N", &m, &n, &one, &symmetric(columns.begin, rows.begin), &stride, values, &next, &one, result, &next);
  }
} // namespace sprag
