// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "results/columns.h"

#include <utility>

namespace sprag
{
  /// A row with these values alone.
  inline Row make_row(const std::vector<std::pair<Column, double>> &values)
  {
    Row row;
    for (const auto &[column, value] : values)
      row[column] = value;
    return row;
  }
} // namespace sprag
