// SPDX-License-Identifier: GPL-3.0-only
#include "report/peak_report.h"

#include "base/local_regression.h"
#include "base/ranges.h"
#include "base/text.h"
#include "results/row_statistics.h"
#include "scene/analysis_use.h"
#include "scene/closed_form.h"
#include "scene/contact_estimates.h"
#include "scene/held_slide.h"
#include "scene/scene.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

namespace sprag
{
  namespace
  {
    /// Row, lever and place of the largest value of a quantity.
    struct Peak
    {
      const Row *row     = nullptr;
      double value       = 0.;
      double place       = 0.;
      double width       = 0.; ///< of the contact
      unsigned int lever = 0;
    };

    constexpr double admitted_error  = 0.05;
    constexpr double admitted_share  = 0.25;        ///< of the travel in contact, on which the contact may be narrower
    constexpr double element_error[] = { 5., 0.8 }; ///< of degree 1 and 2

    /// Looks at rows in which friction has turned. While it turns, the pressure stands out where the slip begins: narrow in place
    /// and travel, and the higher the finer the mesh.
    Peak largest_pressure(const std::vector<Row> &rows)
    {
      const auto counts = friction_has_turned(rows);
      Peak result;
      for (std::size_t i = 0; i < rows.size(); ++i)
        for (const unsigned int lever : { 0u, 1u })
        {
          const auto value = [&](const Column column) { return rows[i].lever_value(column, lever); };
          if (counts[i] && value(Column::largest_pressure) > result.value)
            result = { &rows[i], value(Column::largest_pressure), value(Column::largest_pressure_xi),
                       value(Column::contact_width), lever };
        }
      return result;
    }

    /// Elements in contact that leave the admitted error.
    double enough_elements(const unsigned int degree)
    {
      return std::cbrt(element_error[degree - 1] / admitted_error);
    }

    /// Returns the quantile of the contact's width over the travel in contact [mm]; 0 without travel.
    double width_over_share(const std::vector<Row> &rows, const double share)
    {
      std::vector<std::pair<double, double>> width_and_travel;
      double whole = 0.;
      for (std::size_t i = 1; i < rows.size(); ++i)
        if (const double width = rows[i][Column::contact_width]; width > 0.)
        {
          width_and_travel.push_back({ width, std::abs(rows[i][Column::x] - rows[i - 1][Column::x]) });
          whole += width_and_travel.back().second;
        }
      std::sort(width_and_travel.begin(), width_and_travel.end());
      double sum = 0.;
      for (const auto &[width, travel] : width_and_travel)
        if (sum += travel; sum > share * whole)
          return width;
      return 0.;
    }

    std::string times_the_size(const Scene &scene, const double elements)
    {
      return rounded_text(elements) + " times " +
             (scene.mesh.file.empty() ? "Mesh/Face size" : "the longest side on the friction face, " + mm(scene.mesh.face_size));
    }

    std::string remedy(const Scene &scene, const double width)
    {
      const std::string most = " of at most " + mm(width / enough_elements(scene.mesh.degree));
      return (scene.mesh.file.empty() ? "Try a Mesh/Face size" + most : "Give the friction face of Mesh/File sides" + most) +
             (scene.mesh.degree == 1 ? " or Mesh/Degree = 2." : ".");
    }

    constexpr std::size_t reach = 3; ///< of the regression to both sides, in means

    struct Mean
    {
      double x = 0., pressure = 0.;
      unsigned int rows = 0;
    };

    /// Rows of the stroke of a row, itself included, without those in which the contact has not yet moved by its width since a
    /// reversal; none where that is one of them.
    std::vector<std::size_t> settled_stroke(const std::vector<Row> &rows, const std::size_t peak_row)
    {
      const auto is_along = [&](const std::size_t i)
      { return drive_direction(rows[i][Column::v]) == drive_direction(rows[peak_row][Column::v]); };
      std::size_t begin = peak_row, end = peak_row + 1;
      while (begin > 0 && is_along(begin - 1))
        --begin;
      while (end < rows.size() && is_along(end))
        ++end;
      if (begin > 0)
      {
        const double turned_at = rows[begin - 1][Column::x];
        while (begin < end && std::abs(rows[begin][Column::x] - turned_at) <= rows[begin][Column::contact_width])
          ++begin;
      }
      if (begin > peak_row)
        return {};
      std::vector<std::size_t> result(end - begin);
      std::iota(result.begin(), result.end(), begin);
      return result;
    }
  } // namespace

  SmoothedPressure smoothed_largest_pressure(const std::vector<Row> &rows, const double face_size)
  {
    const auto peak = largest_pressure(rows);
    if (!peak.row)
      return {};
    const auto pressure_at = [&](const std::size_t i) { return rows[i].lever_value(Column::largest_pressure, peak.lever); };
    const auto near_by     = settled_stroke(rows, static_cast<std::size_t>(peak.row - rows.data()));
    if (near_by.empty())
      return { peak.value, 0. };
    double bin = face_size;
    for (std::size_t i = near_by.front() + 1; i <= near_by.back(); ++i)
      bin = std::max(bin, std::abs(rows[i][Column::x] - rows[i - 1][Column::x]));
    std::map<long, Mean> means; // by increasing x
    for (const std::size_t i : near_by)
    {
      auto &mean = means[std::lround(rows[i][Column::x] / bin)];
      ++mean.rows;
      mean.x += (rows[i][Column::x] - mean.x) / mean.rows;
      mean.pressure += (pressure_at(i) - mean.pressure) / mean.rows;
    }
    const auto x        = mapped(means, [](const auto &bin_mean) { return bin_mean.second.x; });
    const auto pressure = mapped(means, [](const auto &bin_mean) { return bin_mean.second.pressure; });
    if (x.size() < 4 * reach)
      return { peak.value, 0. };
    const auto smooth  = locally_fitted(x, pressure, 2. * reach * bin);
    const auto highest = std::max_element(smooth.begin(), smooth.end());
    const auto at      = static_cast<std::size_t>(highest - smooth.begin());
    const auto first   = at < reach ? 0 : at - reach;
    const auto last    = std::min(at + reach, x.size() - 1);
    double sum         = 0.;
    for (std::size_t i = first; i <= last; ++i)
      sum += std::pow(pressure[i] - smooth[i], 2);
    const double scatter = std::sqrt(sum / static_cast<double>(last - first + 1));
    return { *highest, std::max(scatter, peak.value - *highest) / *highest };
  }

  void add_largest_pressure(const std::vector<Row> &rows, std::vector<Entry> &entries, const double face_size)
  {
    const auto peak = largest_pressure(rows);
    if (!peak.row)
      return;
    const double value = face_size > 0. ? smoothed_largest_pressure(rows, face_size).value : peak.value;
    append<Entry>(entries,
                  { { "largest_pressure", value },
                    { "largest_pressure_x", (*peak.row)[Column::x] },
                    { "largest_pressure_direction", drive_direction((*peak.row)[Column::v]) > 0 ? "forward" : "backward" },
                    { "largest_pressure_xi", peak.place } });
  }

  double expected_pressure_error(const double elements, const unsigned int degree)
  {
    return std::min(1., element_error[degree - 1] / std::pow(elements, 3));
  }

  Warnings coarse_contact_warnings(const Scene &scene, const std::vector<Row> &rows)
  {
    const auto peak = largest_pressure(rows);
    if (!peak.row || !(peak.width > 0.))
      return {};
    const double face_size = scene.mesh.face_size;
    const double enough    = enough_elements(scene.mesh.degree);
    const bool is_at_peak  = peak.width / face_size < enough;
    const double width     = is_at_peak ? peak.width : width_over_share(rows, admitted_share);
    if (!is_at_peak && (!(width > 0.) || width >= enough * face_size))
      return {};
    // Faces chosen for a target serve what was asked for: forces, where the pressure has no estimate, or its largest value.
    const bool has_inertia = scene.analysis.type == AnalysisType::transient;
    if (!has_inertia && is_chosen(scene, is_at_peak ? "Mesh/Faces in contact" : "Mesh/Face size"))
      return {};
    const double elements   = width / face_size;
    const std::string error = rounded_text(std::ceil(100. * expected_pressure_error(elements, scene.mesh.degree))) + " %";
    auto warning =
        make_warning("coarse_contact", { is_at_peak ? "Where its pressure is largest, at x = " + mm((*peak.row)[Column::x]) + ","
                                                    : "Over more than " + rounded_text(100. * admitted_share) + " % of its way",
                                         (is_at_peak ? "" : "at most ") + mm(width), times_the_size(scene, elements) });
    const std::string forces = scene.analysis.type == AnalysisType::transient
                                   ? ", and so may P behind a reversal and its overshoot."
                                   : "; P, Q and theta are not.";
    warning.effect           = is_at_peak ? "The largest pressure may be wrong by " + error + forces
                                          : "Where it is as narrow as that the pressure may be wrong by " + error +
                                      " or more; the largest of the run is not" + forces;
    warning.remedy           = remedy(scene, width);
    return { warning };
  }

  Warnings narrow_contact_warnings(const Scene &scene)
  {
    const auto type = scene.analysis.type;
    const bool has_modes =
        type == AnalysisType::modal && is_meshed(scene.analysis.model) && scene.stability.contact != HeldContact::open;
    const bool is_fitted = type == AnalysisType::contact_law || type == AnalysisType::calibration;
    if (!has_modes && !is_fitted)
      return {};
    const double x     = has_modes ? held_drive(scene).x : scene.drive.maximum();
    const double width = estimated_contact_width(scene, std::max(0., closed_form(scene, x, -scene.drive.peak_speed()).P));
    if (!is_narrower_than_faces(scene, width))
      return {};
    auto warning = make_warning("coarse_contact",
                                { "At x = " + mm(x), "about " + mm(width), times_the_size(scene, width / scene.mesh.face_size) });
    warning.effect =
        "The stiffness of the contact, and frequencies that follow from it, may be wrong by a tenth and more; nothing tells by "
        "how much.";
    warning.remedy = remedy(scene, width);
    return { warning };
  }
} // namespace sprag
