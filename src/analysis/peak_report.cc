#include "analysis/peak_report.h"

#include "base/text.h"

#include <algorithm>
#include <cmath>
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
      double width   = 0.; ///< of the contact
    };

    constexpr double admitted_error = 0.05;

    Peak largest(const std::vector<Row> &rows, const Column column, const Column place)
    {
      Peak result;
      const auto look_at = [&](const Row &row, const double value, const double at, const double width)
      {
        if (value > result.value)
          result = { &row, value, at, width };
      };
      for (const Row &row : rows)
      {
        look_at(row, row[column], row[place], row[Column::contact_width]);
        if (!row.second_lever().empty())
          look_at(row, row.of_second_lever(column), row.of_second_lever(place), row.of_second_lever(Column::contact_width));
      }
      return result;
    }

    std::string direction(const Row &row)
    {
      return direction_of(row[Column::v]) > 0 ? "forward" : "backward";
    }
  } // namespace

  void add_largest_pressure(const std::vector<Row> &rows, std::vector<Entry> &entries)
  {
    const auto peak = largest(rows, Column::largest_pressure, Column::largest_pressure_xi);
    if (!peak.row)
      return;
    entries.push_back({ "largest_pressure", peak.value, "MPa", "largest pressure on the friction face over the run" });
    entries.push_back({ "largest_pressure_x", (*peak.row)[Column::x], "mm", "position of the cylinder there" });
    entries.push_back({ "largest_pressure_direction", direction(*peak.row), "", "which way the cylinder moved there" });
    entries.push_back(
        { "largest_pressure_xi", peak.place, "mm", "place of the largest pressure on the lever, distance from the pivot" });
  }

  double expected_pressure_error(const double elements, const unsigned int degree)
  {
    return std::min(1., degree == 1 ? 3. / std::pow(elements, 2) : 0.8 / std::pow(elements, 3));
  }

  Warnings coarse_contact_warnings(const Scene &scene, const std::vector<Row> &rows)
  {
    const auto peak = largest(rows, Column::largest_pressure, Column::largest_pressure_xi);
    if (!peak.row || !scene.mesh.file.empty() || !(peak.width > 0.))
      return {};
    const double elements = peak.width / scene.mesh.face_size;
    const double error    = expected_pressure_error(elements, scene.mesh.degree);
    if (error <= admitted_error)
      return {};
    const double power = scene.mesh.degree == 1 ? 0.5 : 1. / 3.;
    const double finer = scene.mesh.face_size * std::pow(admitted_error / error, power);
    return { { "coarse_contact",
               "Where its pressure is largest, at x = " + rounded_text((*peak.row)[Column::x]) + " mm, the contact is " +
                   rounded_text(peak.width) + " mm wide, " + rounded_text(elements) + " times Mesh/Face size.",
               "The largest pressure may be wrong by " + rounded_text(100. * error) + " %; P, Q and theta are not.",
               "Try a Mesh/Face size of at most " + rounded_text(finer) + " mm" +
                   (scene.mesh.degree == 1 ? " or Mesh/Degree = 2." : ".") } };
  }
} // namespace sprag
