#include "analysis/peak_report.h"

#include <string>

namespace sprag
{
  namespace
  {
    /// Where on which lever of a row something is largest.
    struct Peak
    {
      const Row *row = nullptr;
      double value   = 0.;
      double place   = 0.;
    };

    Peak largest(const std::vector<Row> &rows, const Column column, const Column place)
    {
      Peak result;
      const auto look_at = [&](const Row &row, const double value, const double at)
      {
        if (value > result.value)
          result = { &row, value, at };
      };
      for (const Row &row : rows)
      {
        look_at(row, row[column], row[place]);
        if (!row.second_lever().empty())
          look_at(row, row.of_second_lever(column), row.of_second_lever(place));
      }
      return result;
    }

    std::string direction(const Row &row)
    {
      const double v = row[Column::v];
      return v == 0. ? "at rest" : v > 0. ? "forward" : "backward";
    }
  } // namespace

  void add_largest_pressure(const std::vector<Row> &rows, std::vector<Entry> &entries)
  {
    const auto peak = largest(rows, Column::largest_pressure, Column::largest_pressure_xi);
    if (!peak.row)
      return;
    entries.push_back({ "largest_pressure", peak.value, "MPa", "largest pressure on the friction face over the run" });
    entries.push_back({ "largest_pressure_x", (*peak.row)[Column::x], "mm", "position of the cylinder there" });
    entries.push_back({ "largest_pressure_way", direction(*peak.row), "", "which way the cylinder moved there" });
    entries.push_back(
        { "largest_pressure_xi", peak.place, "mm", "place of the largest pressure on the lever, distance from the pivot" });
  }
} // namespace sprag
