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

    /// Returns friction against the motion over that in full sliding at the drive's speed, as the closed form has it; over the
    /// row's own where a law falls with the speed, or without a closed form. An open contact, without friction, has 1.
    double turned_part(const Row &row)
    {
      const double theta = row[Column::theta_closed_form];
      const double settled =
          std::abs(row[Column::Q_closed_form] / row[Column::P_closed_form] - std::sin(theta)) / std::cos(theta);
      const double full = std::fmax(row[Column::mu], settled) * row[Column::normal_resultant];
      return full > 0. ? std::copysign(1., row[Column::v]) * row[Column::friction_resultant] / full : 1.;
    }

    using Rows = std::vector<Row>::const_iterator;

    /// Returns the end of the stroke that begins at a row.
    Rows stroke_end(const std::vector<Row> &rows, const Rows begin)
    {
      return std::find_if(begin, rows.end(),
                          [&](const Row &row) { return std::signbit(row[Column::v]) != std::signbit((*begin)[Column::v]); });
    }

    /// Returns where a stroke slides in full: the first row with 0.999 of the largest part that turns in it, as elastic levers
    /// slide a little slower than the closed form; within the contact's width behind the reversal, if most turns there. The end
    /// of a stroke that is too short for it.
    Rows first_sliding(const std::vector<Row> &rows, const Rows begin, const Rows end)
    {
      const double from = (*(begin == rows.begin() ? begin : begin - 1))[Column::x];
      const auto near_by =
          std::find_if(begin, end, [&](const Row &row) { return std::abs(row[Column::x] - from) > row[Column::contact_width]; });
      for (const auto last : { near_by, end })
      {
        double most = 0.;
        for (auto row = begin; row != last; ++row)
          most = std::max(most, turned_part(*row));
        if (most >= turned_share)
          return std::find_if(begin, last, [&](const Row &row) { return turned_part(row) >= sliding_share * most; });
      }
      return end;
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
      const auto end   = stroke_end(rows, begin);
      const auto first = [&](const double share)
      { return std::find_if(begin, end, [&](const Row &row) { return resists(row, share); }); };
      const auto turned = first(turned_share) != end ? first(turned_share) : first(0.);
      std::fill(result.begin() + (turned - rows.begin()), result.begin() + (end - rows.begin()), true);
      begin = end;
    }
    return result;
  }

  std::vector<bool> moves_with_friction(const std::vector<Row> &rows, const int direction, const Column column)
  {
    auto result = friction_has_turned(rows);
    std::vector<bool> moves(rows.size());
    for (auto begin = rows.begin(); begin != rows.end();)
    {
      const auto end     = stroke_end(rows, begin);
      const auto sliding = first_sliding(rows, begin, end);
      const auto from    = begin == rows.begin() ? begin : begin - 1;
      for (auto row = begin; row != end; ++row)
      {
        const auto i         = static_cast<std::size_t>(row - rows.begin());
        const auto size      = [&](const Rows at) { return std::copysign(1., (*sliding)[column]) * (*at)[column]; };
        const bool is_passed = row < sliding && sliding != end && !(size(row) > std::max(size(from), size(sliding)));
        moves[i]             = drive_direction((*row)[Column::v]) == direction;
        result[i]            = moves[i] && result[i] && !is_passed;
      }
      begin = end;
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
        const bool is_inside = i > 0 && moves_on(rows, i - 1, i + 1);
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
