// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include <algorithm>
#include <cmath>
#include <complex>
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

  /// Returns the items of two increasing ranges, each once, increasing.
  template <class T>
  std::vector<T> united(const std::vector<T> &a, const std::vector<T> &b)
  {
    std::vector<T> result;
    result.reserve(a.size() + b.size());
    std::set_union(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(result));
    return result;
  }

  /// Orders the items and leaves each once.
  template <class T>
  void sort_unique(std::vector<T> &all)
  {
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
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

  /// Returns the items that satisfy a condition.
  template <class Range, class Condition>
  auto filtered(const Range &items, const Condition &condition)
  {
    std::vector<std::decay_t<decltype(*std::begin(items))>> result;
    std::copy_if(std::begin(items), std::end(items), std::back_inserter(result), condition);
    return result;
  }

  /// Returns the first item for which a function, or a member, has this value; null without any.
  template <class Range, class Function, class Value>
  const auto *find_by(const Range &items, const Function &function, const Value &value)
  {
    const auto has_value = [&](const auto &item) { return std::invoke(function, item) == value; };
    const auto found     = std::find_if(std::begin(items), std::end(items), has_value);
    return found == std::end(items) ? nullptr : &*found;
  }

  /// Returns whether an item equals the value.
  template <class Range, class Value>
  bool contains(const Range &items, const Value &value)
  {
    return std::find(std::begin(items), std::end(items), value) != std::end(items);
  }

  /// Returns the sum of a function over all items, from the first to the last.
  template <class Range, class Function>
  double sum_over(const Range &items, const Function &function)
  {
    double result = 0.;
    for (const auto &item : items)
      result += function(item);
    return result;
  }

  /// Returns the largest size of a function over all items; 0 without any. NaN does not count.
  template <class Range, class Function>
  double largest(const Range &items, const Function &function)
  {
    double result = 0.;
    for (const auto &item : items)
      result = std::max(result, std::abs(function(item)));
    return result;
  }

  /// Returns the root mean square of values; 0 without any.
  inline double root_mean_square(const std::vector<double> &values)
  {
    const double sum = sum_over(values, [](const double value) { return value * value; });
    return values.empty() ? 0. : std::sqrt(sum / static_cast<double>(values.size()));
  }

  /// Returns `first` with `second` at its end.
  template <class T>
  std::vector<T> joined(std::vector<T> first, const std::vector<T> &second)
  {
    append(first, second);
    return first;
  }
} // namespace sprag
