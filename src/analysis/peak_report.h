#pragma once

#include "results/result_file.h"

#include <vector>

namespace sprag
{
  /// Adds the largest pressure on the friction face over a run of finite elements with x, direction and place; of a pair that of
  /// the lever where it is larger. Nothing for models without a face.
  void add_largest_pressure(const std::vector<Row> &rows, std::vector<Entry> &entries);
} // namespace sprag
