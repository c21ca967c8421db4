#include "report/peak_report.h"

#include "base/text.h"
#include "scene/scene.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

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

    constexpr double admitted_error     = 0.05;
    constexpr double admitted_share     = 0.25;        ///< of the way in contact, where the contact is narrower than that takes
    constexpr double error_of_element[] = { 5., 0.8 }; ///< of degree 1 and 2

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

    /// Elements in contact that leave the admitted error.
    double enough_elements(const unsigned int degree)
    {
      return std::cbrt(error_of_element[degree - 1] / admitted_error);
    }

    /// Width below which a share of the way in contact lies [mm]; 0 without a way.
    double width_over_share(const std::vector<Row> &rows, const double share)
    {
      std::vector<std::pair<double, double>> width_and_way;
      double whole = 0.;
      for (std::size_t i = 1; i < rows.size(); ++i)
        if (const double width = rows[i][Column::contact_width]; width > 0.)
        {
          width_and_way.push_back({ width, std::abs(rows[i][Column::x] - rows[i - 1][Column::x]) });
          whole += width_and_way.back().second;
        }
      std::sort(width_and_way.begin(), width_and_way.end());
      double sum = 0.;
      for (const auto &[width, way] : width_and_way)
        if (sum += way; sum > share * whole)
          return width;
      return 0.;
    }

    std::string times_the_size(const Scene &scene, const double elements)
    {
      return rounded_text(elements) + " times " +
             (scene.mesh.file.empty() ? "Mesh/Face size" : "the longest side on the friction face, " + mm(scene.mesh.face_size)) +
             ".";
    }

    std::string remedy(const Scene &scene, const double width)
    {
      const std::string most = " of at most " + mm(width / enough_elements(scene.mesh.degree));
      return (scene.mesh.file.empty() ? "Try a Mesh/Face size" + most : "Give the friction face of Mesh/File sides" + most) +
             (scene.mesh.degree == 1 ? " or Mesh/Degree = 2." : ".");
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
    return std::min(1., error_of_element[degree - 1] / std::pow(elements, 3));
  }

  Warnings coarse_contact_warnings(const Scene &scene, const std::vector<Row> &rows)
  {
    const auto peak = largest(rows, Column::largest_pressure, Column::largest_pressure_xi);
    if (!peak.row || !(peak.width > 0.))
      return {};
    const double elements = peak.width / scene.mesh.face_size;
    const double enough   = enough_elements(scene.mesh.degree);
    if (elements < enough)
      return { { "coarse_contact",
                 "Where its pressure is largest, at x = " + mm((*peak.row)[Column::x]) + ", the contact is " + mm(peak.width) +
                     " wide, " + times_the_size(scene, elements),
                 "The largest pressure may be wrong by " +
                     rounded_text(std::ceil(100. * expected_pressure_error(elements, scene.mesh.degree))) +
                     " %; P, Q and theta are not.",
                 remedy(scene, peak.width) } };
    const double narrow = width_over_share(rows, admitted_share);
    if (!(narrow > 0.) || narrow >= enough * scene.mesh.face_size)
      return {};
    return { { "coarse_contact",
               "Over more than " + rounded_text(100. * admitted_share) + " % of its way the contact is at most " + mm(narrow) +
                   " wide, " + times_the_size(scene, narrow / scene.mesh.face_size),
               "Where it is as narrow as that the pressure may be wrong by " +
                   rounded_text(std::ceil(100. * expected_pressure_error(narrow / scene.mesh.face_size, scene.mesh.degree))) +
                   " % or more; the largest of the run, P, Q and theta are not.",
               remedy(scene, narrow) } };
  }
} // namespace sprag
