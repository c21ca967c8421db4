// SPDX-License-Identifier: GPL-3.0-only
#include "results/row_statistics.h"

#include "scene/drive.h"

#include <algorithm>

namespace sprag
{
  namespace
  {
    constexpr double turned_share  = 0.9;   ///< of friction in full sliding
    constexpr double sliding_share = 0.999; ///< of friction in full sliding

    /// Returns whether friction resists the motion by at least a share of what it is in full sliding. An open contact, without
    /// friction, does.
    bool resists(const Row &row, const double share)
    {
      const double friction = std::signbit(row[Column::v]) ? -row[Column::friction_resultant] : row[Column::friction_resultant];
      return !(friction < share * row[Column::mu] * row[Column::normal_resultant]) && !(friction < 0.);
    }

    bool moves_on(const std::vector<Row> &rows, const std::size_t first, const std::size_t last)
    {
      return last < rows.size() && drive_direction(rows[first][Column::v]) == drive_direction(rows[last][Column::v]);
    }

    /// Returns the size of a peak next to a row, where the lines through the rows before and behind it meet; that of the row if
    /// they do not meet above it.
    double corner(const std::vector<Row> &rows, const Column column, const std::size_t peak)
    {
      const auto size   = [&](const std::size_t i) { return std::copysign(1., rows[peak][column]) * rows[i][column]; };
      const auto length = [&](const std::size_t i) { return std::abs(rows[i][Column::x] - rows[i - 1][Column::x]); };
      const auto slope  = [&](const std::size_t i) { return (size(i) - size(i - 1)) / length(i); };
      double result     = size(peak);
      for (std::size_t i = std::max<std::size_t>(peak, 2); i < peak + 2 && moves_on(rows, i - 2, i + 1); ++i)
      {
        const double rise = slope(i - 1), fall = -slope(i + 1);
        const double share = (slope(i) + fall) / (rise + fall); // of the way between rows i - 1 and i
        if (rise > 0. && fall > 0. && share > 0. && share < 1.)
          result = std::max(result, size(i - 1) + rise * share * length(i));
      }
      return result;
    }

    /// Returns the size of the vertex of the parabola through a row that is larger than its neighbours in time, and these; that
    /// of the row if it is not, or if one step is over twice as long as the other, as before a sudden reversal: the shorter
    /// would bend it.
    double vertex(const std::vector<Row> &rows, const Column column, const std::size_t peak)
    {
      const auto size = [&](const std::size_t i) { return std::copysign(1., rows[peak][column]) * rows[i][column]; };
      const double t0 = rows[peak - 1][Column::time] - rows[peak][Column::time], y0 = size(peak - 1) - size(peak);
      const double t1 = rows[peak + 1][Column::time] - rows[peak][Column::time], y1 = size(peak + 1) - size(peak);
      if (!(t0 < 0. && t1 > 0. && y0 < 0. && y1 < 0. && t1 <= -2. * t0 && -t0 <= 2. * t1))
        return size(peak);
      const double bend  = (y1 / t1 - y0 / t0) / (t1 - t0);
      const double slope = y0 / t0 - bend * t0;
      return size(peak) - 0.25 * slope * slope / bend;
    }
  } // namespace

  std::vector<bool> friction_has_turned(const std::vector<Row> &rows)
  {
    std::vector<bool> result(rows.size(), false);
    for (auto begin = rows.begin(); begin != rows.end();)
    {
      const auto end = std::find_if(
          begin, rows.end(), [&](const Row &row) { return std::signbit(row[Column::v]) != std::signbit((*begin)[Column::v]); });
      const auto first = [&](const double share)
      { return std::find_if(begin, end, [&](const Row &row) { return resists(row, share); }); };
      const auto turned = first(turned_share) != end ? first(turned_share) : first(0.);
      std::fill(result.begin() + (turned - rows.begin()), result.begin() + (end - rows.begin()), true);
      begin = end;
    }
    return result;
  }

  std::vector<bool> moves_with_friction(const std::vector<Row> &rows, const int direction)
  {
    const auto turned = friction_has_turned(rows);
    std::vector<bool> result(rows.size()), moves(rows.size());
    for (std::size_t i = 0; i < rows.size(); ++i)
    {
      moves[i]  = drive_direction(rows[i][Column::v]) == direction;
      result[i] = moves[i] && turned[i];
    }
    return std::find(result.begin(), result.end(), true) == result.end() ? moves : result;
  }

  bool sticks(const Row &row)
  {
    return std::abs(row[Column::friction_resultant]) < sliding_share * row[Column::mu] * row[Column::normal_resultant];
  }

  double peak_between_rows(const std::vector<Row> &rows, const Column column, const std::vector<bool> &counts)
  {
    double result = 0.;
    for (std::size_t i = 0; i < rows.size(); ++i)
      if (counts[i] && std::abs(rows[i][column]) > std::abs(result))
      {
        const auto row       = rows.begin() + static_cast<std::ptrdiff_t>(i);
        const bool is_still  = std::isnan((*row)[Column::kinetic_energy]);
        const bool is_inside = i > 0 && i + 1 < rows.size() && counts[i - 1] && counts[i + 1];
        double size          = std::abs((*row)[column]);
        if (is_still && i > 1 && std::any_of(row - 2, row + 1, sticks))
          size = corner(rows, column, i);
        else if (!is_still && is_inside)
          size = vertex(rows, column, i);
        result = std::copysign(size, rows[i][column]);
      }
    return result;
  }
} // namespace sprag
