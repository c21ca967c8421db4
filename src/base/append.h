// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include <vector>

namespace sprag
{
  /// Adds `more` at the end of `all`.
  template <class T>
  void append(std::vector<T> &all, const std::vector<T> &more)
  {
    all.insert(all.end(), more.begin(), more.end());
  }

  /// Returns `first` with `second` at its end.
  template <class T>
  std::vector<T> joined(std::vector<T> first, const std::vector<T> &second)
  {
    append(first, second);
    return first;
  }
} // namespace sprag
