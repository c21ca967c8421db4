// SPDX-License-Identifier: GPL-3.0-only
#include "model/interface/block_product.h"

namespace sprag
{
  /// Each row is summed column by column, whatever rows stand beside it: a library would let its last bits depend on these.
  void add_block_product(const dealii::FullMatrix<double> &symmetric, const NumberRange &rows, const NumberRange &columns,
                         const double *const values, double *const result)
  {
    const unsigned int n = rows.size();
    for (unsigned int j = 0; j < columns.size(); ++j)
    {
      const double *const row = &symmetric(columns.begin + j, rows.begin), value = values[j];
      for (unsigned int i = 0; i < n; ++i)
        result[i] += value * row[i];
    }
  }
} // namespace sprag
