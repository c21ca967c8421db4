// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "results/row_statistics.h"

#include <gtest/gtest.h>

#include <vector>

namespace sprag
{
  /// Returns the largest difference of a column over its largest value.
  inline double difference(const std::vector<Row> &a, const std::vector<Row> &b, const Column column)
  {
    EXPECT_EQ(a.size(), b.size());
    double result = 0.;
    for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
      result = std::max(result, std::abs(a[i][column] - b[i][column]));
    return result / largest(a, column);
  }
} // namespace sprag
