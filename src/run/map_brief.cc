// SPDX-License-Identifier: GPL-3.0-only
#include "base/text.h"
#include "report/brief_lines.h"
#include "run/briefs.h"

#include <algorithm>

namespace sprag
{
  namespace
  {
    using Rows = std::vector<std::vector<double>>;

    /// From the least to the largest value of a column.
    std::string span(const Rows &rows, const std::size_t column, const std::string &parameter)
    {
      const auto less          = [&](const auto &a, const auto &b) { return a[column] < b[column]; };
      const auto [least, most] = std::minmax_element(rows.begin(), rows.end(), less);
      return parameter + ' ' + four_digits((*least)[column]) + " to " + with_unit((*most)[column], unit_of_parameter(parameter));
    }

    Rows rows_of_direction(const Rows &rows, const double direction)
    {
      Rows result;
      std::copy_if(rows.begin(), rows.end(), std::back_inserter(result), [&](const auto &row) { return row[2] == direction; });
      return result;
    }
  } // namespace

  void print_brief_of_map(std::ostream &stream, const MapSettings &map, const Rows &boundary, const std::vector<Entry> &summary)
  {
    const Known known(summary);
    if (known.text("status") != "completed")
      brief_line(stream, "unfinished", "shares and boundaries below are of the cells judged so far");
    brief_line(stream, "cells",
               four_digits(known.number("grid_points")) + " in the grid, " + four_digits(known.number("cells_judged")) +
                   " judged, the others between cells of one verdict");
    for (const auto &[way, direction] : { std::pair<std::string, double>{ "forward", 1. }, { "backward", -1. } })
    {
      std::string shares = known.share("unstable_" + way) + " of the grid unstable";
      for (const auto &[name, told] :
           { std::pair<std::string, std::string>{ "jammed_", "jammed" }, { "not_judged_", "not judged" } })
        if (known.number(name + way).value_or(0.) > 0.)
          shares += ", " + known.share(name + way) + ' ' + told;
      brief_line(stream, way, shares);
      if (const auto rows = rows_of_direction(boundary, direction); !rows.empty())
        brief_line(stream, "  boundaries",
                   "at " + std::to_string(rows.size()) + " points: " + span(rows, 0, map.first.name) + ", " +
                       span(rows, 1, map.second.name));
    }
    brief_line(stream, "cost",
               formatted("%.2g", known.number("cpu_time_all").value_or(0.)) + " s of CPU time of " +
                   four_digits(known.number("ranks")) + " processes, " +
                   formatted("%.2g", known.number("wall_time").value_or(0.)) + " s passed");
  }
} // namespace sprag
