// SPDX-License-Identifier: GPL-3.0-only
#include "model/block_product.h"

#include "base/lanes.h"

#include <cstring>

// Fused operations would round otherwise than processors without them, and than sums elsewhere.
#pragma GCC push_options
#pragma GCC optimize("fp-contract=off")

namespace sprag
{
  namespace
  {
    SPRAG_PART Lanes eight_at(const double *const place)
    {
      Lanes result;
      std::memcpy(&result, place, sizeof(Lanes));
      return result;
    }
  } // namespace

  /// Each row is summed column by column, whatever rows stand beside it: a library would let its last bits depend on these.
  SPRAG_FOR_ANY_PROCESSOR void add_block_product(const dealii::FullMatrix<double> &symmetric, const NumberRange &rows,
                                                 const NumberRange &columns, const double *const values, double *const result)
  {
    constexpr unsigned int n_together = 4;
    const std::size_t stride          = symmetric.n();
    const double *const first         = &symmetric(columns.begin, rows.begin); // of rows, as it is symmetric
    unsigned int i                    = 0;
    for (; i + n_together * n_lanes <= rows.size(); i += n_together * n_lanes)
    {
      SomeLanes<n_together> sums;
      for (unsigned int k = 0; k < n_together; ++k)
        sums[k] = eight_at(result + i + k * n_lanes);
      for (unsigned int j = 0; j < columns.size(); ++j)
        for (unsigned int k = 0; k < n_together; ++k)
          sums[k] += values[j] * eight_at(first + j * stride + i + k * n_lanes);
      std::memcpy(result + i, &sums, sizeof(sums));
    }
    for (; i + n_lanes <= rows.size(); i += n_lanes)
    {
      Lanes sum = eight_at(result + i);
      for (unsigned int j = 0; j < columns.size(); ++j)
        sum += values[j] * eight_at(first + j * stride + i);
      std::memcpy(result + i, &sum, sizeof(sum));
    }
    for (; i < rows.size(); ++i)
      for (unsigned int j = 0; j < columns.size(); ++j)
        result[i] += values[j] * first[j * stride + i];
  }
} // namespace sprag

#pragma GCC pop_options
