// SPDX-License-Identifier: GPL-3.0-only
#include "report/report.h"

#include "analytic/oscillation.h"
#include "base/errors.h"
#include "base/least_squares.h"
#include "base/ranges.h"
#include "base/text.h"
#include "base/unknown.h"
#include "report/peak_report.h"
#include "report/summary_lines.h"
#include "results/row_statistics.h"
#include "scene/lever_inertia.h"
#include "scene/mirrored_pair.h"
#include "scene/pair_closed_form.h"
#include "scene/scene.h"

#include <algorithm>
#include <boost/algorithm/string/join.hpp>
#include <cmath>
#include <functional>
#include <iomanip>
#include <limits>
#include <ostream>

namespace sprag
{
  namespace
  {
    // Both over the cylinder's radius: 2 mm and 10 mm of model A.
    constexpr double settling     = 1. / 28.; ///< travel after a reversal in which stick hides the closed form
    constexpr double slope_window = 5. / 28.; ///< x over which C_Q is fitted, or over the first three rows
    constexpr double longest      = 1. / 3.;  ///< such x of long steps

    using Rows = std::vector<std::reference_wrapper<const Row>>;

    int drive_direction(const Row &row)
    {
      return sprag::drive_direction(row[Column::v]);
    }

    /// A pair that presses on a cylinder off its middle begins in stick, and so does what goes back at once from where the
    /// cylinder was slid forward.
    bool begins_in_stick(const Row &first)
    {
      return first[Column::P] > 0. && first[Column::friction_resultant] * drive_direction(first) <= 0.;
    }

    /// Returns true if the drive is at rest in a row: friction then depends on the motion before.
    bool rests(const std::vector<Row> &rows, const std::size_t i)
    {
      return i > 0 && rows[i][Column::x] == rows[i - 1][Column::x] && rows[i][Column::time] > rows[i - 1][Column::time];
    }

    /// Rows of one direction of motion, without those within `apart` of the last reversal [mm]; the row of a turning point
    /// belongs to the stroke that ends there.
    Rows stroke(const std::vector<Row> &rows, const int direction, const double apart)
    {
      Rows result;
      double turned_at = begins_in_stick(rows.front()) ? rows.front()[Column::x] : unknown;
      for (std::size_t i = 0; i < rows.size(); ++i)
      {
        if (i > 0 && drive_direction(rows[i]) != drive_direction(rows[i - 1]))
          turned_at = rows[i - 1][Column::x];
        if (drive_direction(rows[i]) == direction && !rests(rows, i) && !(std::abs(rows[i][Column::x] - turned_at) < apart))
          result.emplace_back(rows[i]);
      }
      return result;
    }

    double deviation(const Rows &rows, const Column column, const Column reference)
    {
      const double peak = largest(rows, reference);
      const double off  = largest(rows, [&](const Row &row) { return row[column] - row[reference]; });
      return peak > 0. ? off / peak : unknown;
    }

    constexpr double largest_mu_change = 0.05; ///< over which C_Q has a meaning, over the largest mu

    /// C of the least-squares fit Q = C x + D x^2 over slope_window; NaN with fewer than three rows, or where mu changes on the
    /// way.
    double slope_at_zero(const Rows &rows, const double cylinder_radius)
    {
      const double window = slope_window * cylinder_radius;
      Rows near;
      for (const Row &row : rows)
        if (row[Column::x] > 0. && row[Column::x] <= longest * cylinder_radius)
          near.emplace_back(row);
      std::sort(near.begin(), near.end(), [](const Row &a, const Row &b) { return a[Column::x] < b[Column::x]; });
      if (near.size() < 3 || near.front().get()[Column::x] > window)
        return unknown;
      std::vector<double> x, Q;
      double least_mu = std::numeric_limits<double>::infinity(), largest_mu = 0.;
      for (const Row &row : near)
        if (row[Column::x] <= window || x.size() < 3)
        {
          least_mu   = std::min(least_mu, row[Column::mu]);
          largest_mu = std::max(largest_mu, row[Column::mu]);
          x.push_back(row[Column::x]);
          Q.push_back(row[Column::Q]);
        }
      const bool changes = largest_mu - least_mu > largest_mu_change * largest_mu;
      return changes ? unknown : slope_at_origin(x, Q);
    }

    /// Without inertia; a model without a support has none in it.
    double stored_energy(const Row &row)
    {
      const double support = row[Column::support_energy];
      return row[Column::spring_energy] + row[Column::elastic_energy] + (std::isnan(support) ? 0. : support);
    }

    /// Without a slope at x = 0 where a pair is opened there or a preload presses.
    bool begins_closed(const Scene &scene)
    {
      return scene.spring.rest_angle == 0. && (count_levers(scene) == 1 || scene.pair.cylinder_offset == 0.);
    }

    void add_stroke(const Scene &scene, const std::vector<Row> &rows, const int direction, const std::string &name,
                    std::vector<Entry> &entries)
    {
      const double R     = scene.geometry.cylinder_radius;
      const Rows settled = stroke(rows, direction, settling * R);
      for (const Column column : { Column::P, Column::Q })
      {
        auto counts = moves_with_friction(rows, direction, column);
        for (std::size_t i = 0; i < rows.size(); ++i)
          counts[i] = counts[i] && !rests(rows, i);
        entries.push_back({ "peak_" + column_info(column).name + "_" + name, peak_between_rows(rows, column, counts) });
      }
      if (begins_closed(scene))
        entries.push_back({ "slope_" + name, slope_at_zero(settled, R) });
      const auto second = count_levers(rows) == 2 ? lever_rows({ settled.begin(), settled.end() }, 1) : std::vector<Row>();
      for (const auto &[column, reference] :
           { std::pair{ Column::P, Column::P_closed_form }, std::pair{ Column::Q, Column::Q_closed_form },
             std::pair{ Column::theta, Column::theta_closed_form } })
      {
        const double first = deviation(settled, column, reference);
        entries.push_back(
            { "deviation_" + column_info(column).name + "_" + name,
              second.empty() ? first : std::max(first, deviation({ second.begin(), second.end() }, column, reference)) });
      }
    }

    /// Adds tilt and skew of an axis on a compliant shaft, at the largest P.
    void add_slopes(const Scene &scene, const std::vector<Row> &rows, std::vector<Entry> &entries)
    {
      if (scene.analysis.dimension != 3 || !scene.cylinder.has_free_axis())
        return;
      const auto by_P    = [](const Row &a, const Row &b) { return a[Column::P] < b[Column::P]; };
      const auto &across = std::max_element(rows.begin(), rows.end(), by_P)->across;
      const auto tilt    = columns_across().size();
      append<Entry>(entries, { { "tilt", across[tilt] }, { "skew", across[tilt + 1] } });
    }

    /// Returns the largest deviation of P, Q and theta on both strokes [-]; NaN if one of them is unknown.
    double largest_deviation(const std::vector<Entry> &summary)
    {
      double result = 0.;
      for (const auto &entry : summary)
        if (entry.name.rfind("deviation_", 0) == 0)
        {
          const double deviation = std::get<double>(entry.value);
          if (std::isnan(deviation))
            return deviation;
          result = std::max(result, deviation);
        }
      return result;
    }

    double residual_share(const std::vector<Row> &rows)
    {
      constexpr Column terms[] = { Column::drive_work, Column::friction_work, Column::spring_energy, Column::kinetic_energy };
      const double work        = largest(terms, [&](const Column column) { return largest(rows, column); });
      return work > 0. ? largest(rows, Column::energy_residual) / work : 0.;
    }

    void add_peaks(const std::vector<Row> &rows, std::vector<Entry> &entries)
    {
      for (const auto &[direction, name] : { std::pair<int, std::string>{ 1, "forward" }, { -1, "backward" } })
      {
        if (stroke(rows, direction, 0.).empty())
          continue;
        for (const Column column : { Column::P, Column::Q, Column::Q_support })
          entries.push_back({ "peak_" + column_info(column).name + "_" + name,
                              peak_between_rows(rows, column, moves_with_friction(rows, direction, column)) });
      }
    }

    std::string contact_text(const Scene &scene)
    {
      if (is_meshed(scene.analysis.model))
        return "contact along the friction face by penalty";
      if (scene.analysis.model == ModelType::closed_form || scene.contact.type == ContactType::ideal)
        return "ideal contact, which cannot open";
      return "contact P = " + rounded_text(scene.contact.stiffness) +
             " N/mm^n delta^n, n = " + rounded_text(scene.contact.exponent) + ", which can open";
    }

    std::string lever_text(const Scene &scene)
    {
      switch (scene.analysis.model)
      {
      case ModelType::closed_form:
        return "rigid lever without mass";
      case ModelType::rigid:
        return "rigid lever with J = " + rounded_text(moment_of_inertia(scene)) + " t mm2";
      case ModelType::beam:
        return "lever of Euler-Bernoulli beam elements with J = " + rounded_text(moment_of_inertia(scene)) + " t mm2";
      case ModelType::condensed:
        return "meshed lever condensed to " + std::to_string(scene.condensed.modes) + " modes and the static shapes of its face";
      case ModelType::finite_element:
        return "meshed lever";
      }
      return {};
    }

    /// Adds the first stick on the way back that passes where a rigid lever locks and ends, of one lever's rows.
    void add_stick_past_locking(const std::vector<Row> &rows, std::vector<Entry> &entries)
    {
      const auto moves_back = [](const Row &row) { return row[Column::v] < 0. && row[Column::P] > 0.; };
      const Row *begin      = nullptr;
      bool locks            = false;
      for (const Row &row : rows)
        if (moves_back(row) && sticks(row))
        {
          begin = begin == nullptr ? &row : begin;
          locks = locks || std::isnan(row[Column::P_closed_form]);
        }
        else if (moves_back(row) && locks)
          return append<Entry>(
              entries, { { "stick_past_locking_begin", (*begin)[Column::x] }, { "stick_past_locking_end", row[Column::x] } });
        else
        {
          begin = nullptr;
          locks = false;
        }
    }

    /// Element length along the friction face [mm]; 0: none.
    double element_size(const Scene &scene)
    {
      return is_meshed(scene.analysis.model) ? scene.mesh.face_size : 0.;
    }
  } // namespace

  void add_closed_form(const Scene &scene, Row &row)
  {
    const double moved = row[Column::support_displacement];
    const double x     = row[Column::x] - (std::isnan(moved) ? 0. : moved);
    const double v     = row[Column::v];
    const auto fill    = [](const ClosedFormState &state, const auto &set)
    {
      set(Column::theta_closed_form, state.contact.theta);
      if (state.P < 0. || !std::isfinite(state.P))
        return;
      set(Column::P_closed_form, state.P);
      set(Column::Q_closed_form, state.Q);
    };
    const auto set_first = [&](const Column column, const double value) { row[column] = value; };
    if (count_levers(scene) == 1)
      return fill(closed_form(scene, x, v), set_first);
    const auto levers = pair_closed_form(scene, x, v);
    fill(levers[0].state, set_first);
    if (!row.second_lever().empty())
      fill(levers[1].state, [&](const Column column, const double value) { row.set_second_value(column, value); });
  }

  std::vector<Entry> make_summary(const Scene &scene, const std::vector<Row> &rows)
  {
    std::vector<Entry> entries;
    if (rows.empty())
      return entries;
    for (const auto &[direction, name] : { std::pair<int, std::string>{ 1, "forward" }, { -1, "backward" } })
      if (!stroke(rows, direction, 0.).empty())
      {
        add_stroke(scene, rows, direction, name, entries);
        if (!begins_closed(scene))
          continue;
        const double mu = closed_form(scene, 0., direction * scene.drive.peak_speed()).mu;
        entries.push_back(
            { "representative_slope_" + name, representative_slope(scene.geometry, scene.spring.stiffness, mu, direction) });
      }

    const Row &last         = rows.back();
    const double work       = last[Column::drive_work];
    const double dissipated = last[Column::friction_work];
    const double stored     = stored_energy(last) - stored_energy(rows.front());
    append<Entry>(entries,
                  { { "loop_area", work }, { "friction_work", dissipated }, { "energy_residual", work - dissipated - stored } });
    add_stick_past_locking(rows, entries);
    add_largest_pressure(rows, entries, scene.mesh.face_size);
    add_slopes(scene, rows, entries);
    const double penetration = largest(rows, Column::penetration);
    entries.push_back({ "penetration", penetration });
    if (scene.layer.thickness > 0.)
      entries.push_back({ "penetration_share", penetration / scene.layer.thickness });
    append<Entry>(entries, { { "cone_violation", largest(rows, Column::cone_violation) },
                             { "elastic_slip", largest(rows, Column::elastic_slip) },
                             { "steps", static_cast<double>(rows.size()) - 1. },
                             { "iterations", sum(rows, Column::iterations) },
                             { "augmentations", sum(rows, Column::augmentations) },
                             { "augmentations_worst", largest(rows, Column::augmentations) } });
    return entries;
  }

  void add_pair(const std::vector<Row> &rows, std::vector<Entry> &entries)
  {
    if (count_levers(rows) == 1)
      return;
    const auto second = lever_rows(rows, 1);
    for (const Column column : { Column::P, Column::Q })
      for (const auto &[direction, name] : { std::pair<int, std::string>{ 1, "forward" }, { -1, "backward" } })
        entries.push_back({ "second_peak_" + column_info(column).name + "_" + name,
                            peak_between_rows(second, column, moves_with_friction(second, direction, column)) });
    const auto difference = [](const Row &row) { return row[Column::P] - row.second_value(Column::P); };
    append<Entry>(entries, { { "peak_lateral_force", signed_peak(rows, [](const Row &row) { return row.lateral_force(); }) },
                             { "peak_swing", signed_peak(rows, [](const Row &row) { return row.swing(); }) },
                             { "peak_difference_P", signed_peak(rows, difference) } });
  }

  void print_summary(std::ostream &stream, const std::vector<Entry> &summary)
  {
    for (const auto &entry : summary)
    {
      stream << "  " << std::left << std::setw(26) << entry.name << ' ' << std::right;
      if (const double *number = std::get_if<double>(&entry.value))
        stream << std::setw(13) << std::setprecision(6) << *number << ' ' << (entry.unit == "1" ? "" : entry.unit);
      else
        stream << std::get<std::string>(entry.value);
      stream << '\n';
    }
  }

  Warnings deviation_warnings(const std::vector<Entry> &summary)
  {
    static const std::string start = "deviation_"; // "deviation_P_forward"
    double largest                 = 0.2;
    std::string worst;
    for (const auto &entry : summary)
      if (entry.name.rfind(start + "P_", 0) == 0 || entry.name.rfind(start + "Q_", 0) == 0)
        if (const double deviation = std::get<double>(entry.value); deviation > largest)
        {
          largest = deviation;
          worst   = entry.name.substr(start.size(), 1) + " moving " + entry.name.substr(start.size() + 2);
        }
    if (worst.empty())
      return {};
    return { make_warning("far_from_closed_form", { worst, percent(largest) }) };
  }

  void check_deviation(const Scene &scene, const std::vector<Entry> &summary)
  {
    const double limit = scene.analysis.maximum_deviation;
    const double found = largest_deviation(summary);
    if (limit > 0. && std::isnan(found))
      throw AnalysisError("Analysis/Maximum deviation = " + rounded_text(limit) +
                          ": the deviation from the closed form cannot be told: each stroke needs steps more than " +
                          mm(settling * scene.geometry.cylinder_radius) +
                          " beyond its reversal. Try a longer Drive/Stroke or a shorter Analysis/Step.");
    if (limit > 0. && !(found <= limit))
      throw AnalysisError("the deviation from the closed form, " + rounded_text(found) +
                          ", is larger than Analysis/Maximum deviation = " + rounded_text(limit) +
                          ". Try a finer Mesh/Face size or a stiffer lever, or admit more.");
  }

  Warnings transient_warnings(const Scene &scene, const std::vector<Row> &rows)
  {
    const double size = element_size(scene);
    if (rows.empty() || size == 0.)
      return {};
    return element_passing_warnings(oscillations(rows, scene.drive, size), size);
  }

  std::vector<Entry> transient_summary(const Scene &scene, const std::vector<Row> &rows)
  {
    std::vector<Entry> entries;
    if (rows.empty())
      return entries;
    add_peaks(rows, entries);
    const Row &last = rows.back();
    append<Entry>(entries, { { "loop_area", last[Column::drive_work] },
                             { "friction_work", last[Column::friction_work] },
                             { "damping_work", last[Column::damping_work] },
                             { "algorithmic_work", last[Column::algorithmic_work] },
                             { "energy_residual", largest(rows, Column::energy_residual) },
                             { "energy_residual_share", residual_share(rows) } });
    add_largest_pressure(rows, entries);
    append<Entry>(entries, { { "penetration", largest(rows, Column::penetration) },
                             { "cone_violation", largest(rows, Column::cone_violation) },
                             { "creep", last[Column::creep] },
                             { "steps", static_cast<double>(rows.size()) - 1. },
                             { "rejected_steps", sum(rows, Column::rejected_steps) },
                             { "iterations", sum(rows, Column::iterations) } });
    const auto reversals = oscillations(rows, scene.drive, element_size(scene));
    append(entries, oscillation_entries(reversals));
    append(entries, swing_entries(largest_swing(rows, reversals, scene.drive.reversal_duration())));
    return entries;
  }

  std::vector<std::string> modelled(const Scene &scene)
  {
    const bool massless = scene.analysis.model == ModelType::closed_form;
    const bool ideal    = massless || scene.contact.type == ContactType::ideal;
    const bool elastic  = !massless && scene.analysis.model != ModelType::rigid;
    const bool meshed   = elastic && scene.analysis.model != ModelType::beam;
    std::vector<std::string> with;
    std::vector<std::string> without;
    const auto part = [&](const bool present, const std::string &name) { (present ? with : without).push_back(name); };

    with = { lever_text(scene), "rotational spring", contact_text(scene) };
    part(elastic, "bending");
    part(meshed && scene.layer.thickness > 0., "friction layer");
    part(elastic && (scene.lever.modal_damping > 0. || scene.lever.mass_damping > 0. || scene.lever.stiffness_damping > 0.),
         "structural damping");
    part(!ideal && scene.contact.damping > 0., "contact damping");
    part(scene.support.type == SupportType::sprung, "sprung support");
    part(scene.pair.type == PairType::full, "second lever");
    part(scene.lever.tip_mass > 0. && !massless, "tip mass");
    part(!ideal && scene.friction.regularisation_speed == 0., "stick");

    std::vector<std::string> lines = { "Modelled:     " + boost::algorithm::join(with, ", ") };
    if (!without.empty())
      lines.push_back("Not modelled: " + boost::algorithm::join(without, ", "));
    lines.push_back(scene.time.tolerance > 0. && !ideal ? "Time:         adaptive steps, first " + rounded_text(scene.time.step) +
                                                              " s, tolerance " + rounded_text(scene.time.tolerance)
                                                        : "Time:         steps of " + rounded_text(scene.time.step) + " s");
    return lines;
  }

  void check_ledger(const Scene &scene, const LedgerReport &ledger)
  {
    const double limit = scene.analysis.maximum_residual;
    if (limit == 0. || ledger.share() <= limit)
      return;
    throw AnalysisError("the energy ledger leaves open " + rounded_text(ledger.share()) +
                        " of the largest work, more than Analysis/Maximum energy residual = " + rounded_text(limit) +
                        "; it opened most at t = " + rounded_text(ledger.time) + " s, where " + ledger.term +
                        " changed most. Try a shorter Time/Step or a smaller Time/Tolerance.");
  }
} // namespace sprag
