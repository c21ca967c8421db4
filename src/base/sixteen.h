// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "base/lanes.h"

#include <cstddef>
#include <vector>

namespace sprag
{
  /// Sixteen numbers in single precision that are computed with at once, see Lanes.
  struct alignas(64) Sixteen
  {
    static constexpr unsigned int n = 16;

    float values __attribute__((vector_size(4 * n))) = {};
  };

  SPRAG_PART float sum(const Sixteen &some)
  {
    using Eight        = float __attribute__((vector_size(32)));
    using Four         = float __attribute__((vector_size(16)));
    const auto &all    = some.values;
    const Eight halves = __builtin_shufflevector(all, all, 0, 1, 2, 3, 4, 5, 6, 7) +
                         __builtin_shufflevector(all, all, 8, 9, 10, 11, 12, 13, 14, 15);
    const Four quarters =
        __builtin_shufflevector(halves, halves, 0, 1, 2, 3) + __builtin_shufflevector(halves, halves, 4, 5, 6, 7);
    return (quarters[0] + quarters[2]) + (quarters[1] + quarters[3]);
  }

  /// Rows of numbers in single precision, 0 at first. A row is a number of groups of sixteen that four divides, and 0 beyond its
  /// last number.
  class RowsOfSixteen
  {
  public:
    RowsOfSixteen(const std::size_t n_rows, const std::size_t n_columns)
        : n_groups((n_columns + 4 * Sixteen::n - 1) / (4 * Sixteen::n) * 4)
        , values(n_rows * n_groups)
    {
    }

    /// Groups of a row.
    std::size_t groups() const
    {
      return n_groups;
    }

    Sixteen *operator[](const std::size_t row)
    {
      return &values[row * n_groups];
    }
    const Sixteen *operator[](const std::size_t row) const
    {
      return &values[row * n_groups];
    }

    float &operator()(const std::size_t row, const std::size_t column)
    {
      return reinterpret_cast<float *>((*this)[row])[column];
    }
    const float &operator()(const std::size_t row, const std::size_t column) const
    {
      return reinterpret_cast<const float *>((*this)[row])[column];
    }

  private:
    std::size_t n_groups;
    std::vector<Sixteen> values;
  };
} // namespace sprag
