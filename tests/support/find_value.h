// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "base/ranges.h"
#include "results/result_file.h"

#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

namespace sprag
{
  /// Returns the value of the entry of this name; throws std::out_of_range if there is none.
  inline double find_value(const std::vector<Entry> &entries, const std::string &name)
  {
    const auto *const entry = find_by(entries, &Entry::name, name);
    if (entry == nullptr)
      throw std::out_of_range("no entry '" + name + "'");
    return std::get<double>(entry->value);
  }
} // namespace sprag
