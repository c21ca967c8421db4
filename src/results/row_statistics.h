// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "base/ranges.h"
#include "results/columns.h"

#include <cmath>
#include <vector>

namespace sprag
{
  // Statistics of ranges of rows, or of any range that `value` accepts. NaN does not count.

  /// Returns the value of largest size with its sign; 0 without any.
  template <class Rows, class Value>
  double signed_peak(const Rows &rows, const Value &value)
  {
    double result = 0.;
    for (const auto &row : rows)
      if (const double found = value(row); std::abs(found) > std::abs(result))
        result = found;
    return result;
  }

  /// Returns the largest size in a column; 0 without any.
  template <class Rows>
  double largest(const Rows &rows, const Column column)
  {
    return largest(rows, [column](const Row &row) { return row[column]; });
  }

  /// Returns rows of a pair as they are of its first (0) or second (1) lever, see Row::lever_row().
  inline std::vector<Row> lever_rows(const std::vector<Row> &rows, const unsigned int lever)
  {
    return mapped(rows, [=](const Row &row) { return row.lever_row(lever); });
  }

  /// Returns the number of levers that rows are of.
  inline unsigned int count_levers(const std::vector<Row> &rows)
  {
    return rows.empty() || rows.front().second_lever().empty() ? 1 : 2;
  }

  /// Returns the sum of a column.
  template <class Rows>
  double sum(const Rows &rows, const Column column)
  {
    return sum_over(rows, [column](const Row &row) { return std::isnan(row[column]) ? 0. : row[column]; });
  }

  /// Returns the row with the largest finite value; null where no value is positive.
  template <class Rows, class Value>
  const Row *find_largest_row(const Rows &rows, const Value &value)
  {
    const Row *result = nullptr;
    double found      = 0.;
    for (const Row &row : rows)
      if (const double candidate = value(row); std::isfinite(candidate) && candidate > found)
      {
        found  = candidate;
        result = &row;
      }
    return result;
  }

  /// Returns of every row whether friction has turned with the motion: true from the first row of each stroke in which it is 0.9
  /// of what it is in full sliding. In a stroke that ends before, true from where it acts against the motion.
  std::vector<bool> friction_has_turned(const std::vector<Row> &rows);

  /// Returns of every row whether a column's value in it is one of motion in a direction, +1 or -1, with friction that has
  /// turned. Until all slides at the drive's speed that is a value beyond those on both sides of the turn: others are on their
  /// way, and may be larger than with weak friction all behind them. Where friction turns in no row of this direction all of them
  /// count: the motion is shorter than stick.
  std::vector<bool> moves_with_friction(const std::vector<Row> &rows, int direction, Column column);

  /// Returns whether a part of the contact sticks: friction is less than 0.999 of what it is in full sliding.
  bool sticks(const Row &row);

  /// Returns the value of largest size in a column of the rows that count, with its sign, between rows too. Without inertia, just
  /// behind stick, it is a corner, at which the last point slips: the lines through the rows on both sides meet there. With
  /// inertia it is the vertex of the parabola over time through three rows.
  double peak_between_rows(const std::vector<Row> &rows, Column column, const std::vector<bool> &counts);
} // namespace sprag
