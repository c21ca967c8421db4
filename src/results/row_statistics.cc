// SPDX-License-Identifier: GPL-3.0-only
#include "results/row_statistics.h"

#include <algorithm>

namespace sprag
{
  namespace
  {
    constexpr double turned_share = 0.9; ///< of friction in full sliding

    /// Returns whether friction resists the motion by at least a share of what it is in full sliding. An open contact, without
    /// friction, does.
    bool resists(const Row &row, const double share)
    {
      const double friction = std::signbit(row[Column::v]) ? -row[Column::friction_resultant] : row[Column::friction_resultant];
      return !(friction < share * row[Column::mu] * row[Column::normal_resultant]) && !(friction < 0.);
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
} // namespace sprag
