// SPDX-License-Identifier: GPL-3.0-only
#include "report/transient_report.h"

#include "analytic/oscillation.h"
#include "base/append.h"
#include "base/errors.h"
#include "base/text.h"
#include "report/peak_report.h"
#include "results/row_statistics.h"
#include "scene/contact_reference.h"
#include "scene/scene.h"

#include <boost/algorithm/string/join.hpp>

#include <algorithm>
#include <cmath>

namespace sprag
{
  namespace
  {
    /// Vertex of the parabola through a row that is larger than its neighbours in time, and these.
    double vertex(const Row &before, const Row &row, const Row &after, const Column column)
    {
      const double t0 = before[Column::time] - row[Column::time], t1 = after[Column::time] - row[Column::time];
      const double y0 = before[column] - row[column], y1 = after[column] - row[column];
      const double bend  = (y1 / t1 - y0 / t0) / (t1 - t0);
      const double slope = y0 / t0 - bend * t0;
      return row[column] - 0.25 * slope * slope / bend;
    }

    /// Value of largest size while moving one way, from where friction has turned with the motion, between rows too.
    double peak(const std::vector<Row> &rows, const Column column, const int direction)
    {
      const auto has_turned = friction_has_turned(rows);
      const auto counts = [&](const std::size_t i) { return has_turned[i] && drive_direction(rows[i][Column::v]) == direction; };
      double result     = 0.;
      for (std::size_t i = 0; i < rows.size(); ++i)
        if (counts(i) && std::abs(rows[i][column]) > std::abs(result))
        {
          const bool has_both = i > 0 && i + 1 < rows.size() && counts(i - 1) && counts(i + 1);
          const auto size     = [&](const std::size_t j) { return std::copysign(1., rows[i][column]) * rows[j][column]; };
          const bool is_peak  = has_both && size(i) > size(i - 1) && size(i) > size(i + 1) &&
                               rows[i - 1][Column::time] < rows[i][Column::time] &&
                               rows[i][Column::time] < rows[i + 1][Column::time];
          result = is_peak ? vertex(rows[i - 1], rows[i], rows[i + 1], column) : rows[i][column];
        }
      return result;
    }

    double residual_share(const std::vector<Row> &rows)
    {
      double work = 0.;
      for (const auto column : { Column::drive_work, Column::friction_work, Column::spring_energy, Column::kinetic_energy })
        work = std::max(work, largest(rows, column));
      return work > 0. ? largest(rows, Column::energy_residual) / work : 0.;
    }

    void add_peaks(const std::vector<Row> &rows, std::vector<Entry> &entries)
    {
      for (const auto &[direction, way] : { std::pair<int, std::string>{ 1, "forward" }, { -1, "backward" } })
        append<Entry>(entries, { { "peak_P_" + way, peak(rows, Column::P, direction) },
                                 { "peak_Q_" + way, peak(rows, Column::Q, direction) },
                                 { "peak_Q_support_" + way, peak(rows, Column::Q_support, direction) } });
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

    /// Element length along the friction face [mm]; 0: none.
    double element_size(const Scene &scene)
    {
      return is_meshed(scene.analysis.model) ? scene.mesh.face_size : 0.;
    }
  } // namespace

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
    append(entries, swing_entries(largest_swing(rows, reversals, scene.drive.reversal_duration()), rows));
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
