#pragma once

#include "results/result_file.h"

namespace sprag
{
  /// A dataset with a value of each item of a range.
  template <class Items, class Value>
  Dataset dataset_of(const Items &items, const ColumnInfo &info, const Value &value)
  {
    Dataset result{ info, {}, {} };
    for (const auto &item : items)
      result.values.push_back(value(item));
    return result;
  }
} // namespace sprag
