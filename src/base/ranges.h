// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include <functional>
#include <iterator>
#include <type_traits>
#include <vector>

namespace sprag
{
  /// Adds `more` at the end of `all`.
  template <class T>
  void append(std::vector<T> &all, const std::vector<T> &more)
  {
    all.insert(all.end(), more.begin(), more.end());
  }

  /// Returns the values of a function, or of a member, for all items of a range.
  template <class Range, class Function>
  auto mapped(const Range &items, const Function &function)
  {
    std::vector<std::decay_t<decltype(std::invoke(function, *std::begin(items)))>> result;
    for (const auto &item : items)
      result.push_back(std::invoke(function, item));
    return result;
  }

  /// Returns `first` with `second` at its end.
  template <class T>
  std::vector<T> joined(std::vector<T> first, const std::vector<T> &second)
  {
    append(first, second);
    return first;
  }
} // namespace sprag
