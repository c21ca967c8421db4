// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include <boost/container/small_vector.hpp>
#include <deal.II/lac/full_matrix.h>

namespace sprag
{
  /// Numbers that follow each other, the first and that beyond the last.
  struct NumberRange
  {
    unsigned int begin;
    unsigned int end;

    unsigned int size() const
    {
      return end - begin;
    }
  };

  /// Ranges that increasing numbers make up.
  template <class Iterator>
  auto find_ranges(Iterator number, const Iterator end)
  {
    boost::container::small_vector<NumberRange, 8> result;
    for (; number != end; ++number)
    {
      if (result.empty() || result.back().end != *number)
        result.push_back({ *number, *number });
      ++result.back().end;
    }
    return result;
  }

  /// Adds the product of a block of a symmetric matrix with values, one a column of the block, to others, one a row.
  void add_block_product(const dealii::FullMatrix<double> &symmetric, const NumberRange &rows, const NumberRange &columns,
                         const double *values, double *result);
} // namespace sprag
