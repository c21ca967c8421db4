// SPDX-License-Identifier: GPL-3.0-only
#include "run/study_print.h"

#include "base/phase_timer.h"
#include "base/text.h"
#include "report/brief_lines.h"
#include "report/percent.h"
#include "run/study_report.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <ostream>
#include <utility>

namespace sprag
{
  namespace
  {
    constexpr std::size_t most_runs_printed = 5; ///< of those that failed, and of those that were refused
    constexpr std::size_t usual_accuracy    = 1; ///< of the recommended ones, 1 %
    const std::string all                   = "all";

    using StudyRows = std::vector<const StudyRecord *>;

    std::string settings_with_units(const StudySettings &study, const StudyPoint &point)
    {
      std::string text;
      for (std::size_t i = 0; i < point.size(); ++i)
      {
        const auto &varied = study.varied[i];
        const auto unit    = unit_of_parameter(varied.name);
        text += (i == 0 ? "" : ", ") + varied.name + " = " + varied.values[point[i]] + (unit.empty() ? "" : ' ' + unit);
      }
      return text;
    }

    std::string reference_text(const StudySettings &study)
    {
      std::string text;
      for (const auto &[name, values] : study.reference_values)
        text += (text.empty() ? "" : ", ") + name + " = " + values.front() +
                (unit_of_parameter(name).empty() ? "" : ' ' + unit_of_parameter(name));
      return text;
    }

    std::string accuracy_text(const double accuracy)
    {
      return rounded_text(100. * accuracy) + " %";
    }

    void print_unfinished(std::ostream &stream, const StudySettings &study, const std::vector<StudyPoint> &points,
                          const std::vector<const StudyRecord *> &rows, const RunOutcome outcome)
    {
      std::size_t printed = 0;
      for (const auto *row : rows)
        if (row->outcome == outcome && printed++ < most_runs_printed)
          stream << "  " << outcome_name(outcome) << ": " << settings_with_units(study, points[row->run]) << ": " << row->reason
                 << '\n';
      if (printed > most_runs_printed)
        stream << "  ... and " << printed - most_runs_printed << " more " << outcome_name(outcome) << '\n';
    }

    struct Printer
    {
      std::ostream &stream;
      const StudySettings &study;
      const std::vector<StudyPoint> &points;
      const StudyRows &rows;

      std::string run_text(const std::optional<std::size_t> &row, const MeasuredErrors &measured) const
      {
        if (!row)
          return "none";
        return settings_with_units(study, points[rows[*row]->run]) + ": " + formatted("%.3g", rows[*row]->cpu_time) +
               " s of CPU time, " + percent(measured.errors[*row]) + " off";
      }

      void accuracies(const MeasuredErrors &measured) const
      {
        brief_line(stream, measured.measure.name, "");
        for (std::size_t i = 0; i < recommended_accuracies.size(); ++i)
          brief_line(stream, "  within " + accuracy_text(recommended_accuracies[i]), run_text(measured.recommended[i], measured));
      }

      void at_usual_accuracy(const std::vector<MeasuredErrors> &all_measured) const
      {
        brief_line(stream, "each alone within " + accuracy_text(recommended_accuracies[usual_accuracy]), "");
        for (const auto &measured : all_measured)
          if (measured.measure.name != all)
            brief_line(stream, "  " + measured.measure.name, run_text(measured.recommended[usual_accuracy], measured));
      }
    };

    /// Of each size, for each measure from the least to the largest of all other settings.
    void print_orders(std::ostream &stream, const std::vector<ObservedOrder> &orders)
    {
      std::map<std::pair<std::string, std::string>, std::pair<double, double>> ranges;
      for (const auto &[measure, parameter, others, order] : orders)
      {
        auto &range = ranges.insert({ { parameter, measure }, { order, order } }).first->second;
        range       = { std::min(range.first, order), std::max(range.second, order) };
      }
      std::map<std::string, std::string> texts;
      for (const auto &[of, range] : ranges)
      {
        auto &text = texts[of.first];
        text += (text.empty() ? "" : ", ") + of.second + formatted(" %.2f", range.first) +
                (range.first < range.second ? formatted(" to %.2f", range.second) : "");
      }
      for (const auto &[parameter, text] : texts)
        brief_line(stream, "observed order", "over " + parameter + ": " + text);
    }

    /// Entries of a summary that answer what an analysis is asked for.
    std::vector<std::string> headlines(const AnalysisType type)
    {
      static const std::map<AnalysisType, std::vector<std::string>> all_headlines = {
        { AnalysisType::quasi_static,
          { "peak_P_forward", "peak_P_backward", "peak_Q_forward", "peak_Q_backward", "loop_area", "largest_pressure" } },
        { AnalysisType::transient, { "peak_P_forward", "peak_P_backward", "reversal_1_frequency", "largest_pressure" } },
        { AnalysisType::slope, { "critical_inclination" } },
        { AnalysisType::modal, { "frequency_1", "frequency_2", "frequency_3" } },
        { AnalysisType::stability, { "growth_rate", "frequency", "P" } },
        { AnalysisType::sprag_slip, { "measured_growth_rate", "measured_frequency", "cycle_amplitude_P" } },
        { AnalysisType::isolation,
          { "residual_offset", "largest_displacement", "largest_acceleration", "transmissibility_fundamental",
            "transmissibility_rms" } },
        { AnalysisType::contact_law, { "stiffness", "exponent" } },
        { AnalysisType::calibration, { "stiffness", "moment_of_inertia", "bending_stiffness", "contact_stiffness" } },
      };
      const auto found = all_headlines.find(type);
      return found == all_headlines.end() ? std::vector<std::string>() : found->second;
    }

    void print_range(std::ostream &stream, const Printer &printer, const std::string &name)
    {
      struct Found
      {
        double value;
        std::string unit;
        std::size_t run;
      };
      std::vector<Found> found;
      for (const auto *row : printer.rows)
        if (const auto *const entry = find_entry(*row, name))
          if (const double *number = std::get_if<double>(&entry->value); number != nullptr && std::isfinite(*number))
            found.push_back({ *number, entry->unit, row->run });
      if (found.empty())
        return;
      // Peaks of a force that acts backward are negative: the largest is that of the largest magnitude.
      const bool is_peak = name.rfind("peak_", 0) == 0;
      const auto size    = [is_peak](const Found &one) { return is_peak ? std::abs(one.value) : one.value; };
      const auto [least, most] =
          std::minmax_element(found.begin(), found.end(), [&size](const Found &a, const Found &b) { return size(a) < size(b); });
      brief_line(stream, name,
                 four_digits(least->value) + " to " + with_unit(most->value, most->unit) + ", most for " +
                     settings_with_units(printer.study, printer.points[most->run]));
    }
  } // namespace

  void print_study(std::ostream &stream, const StudySettings &study, const std::vector<StudyPoint> &points,
                   const StudyRecords &records, const StudyTrade &trade, const bool in_full)
  {
    const auto rows = finished_rows(points, records);
    stream << "  " << rows.size() << " of " << points.size() << " runs: " << count_of(rows, RunOutcome::completed)
           << " completed, " << count_of(rows, RunOutcome::failed) << " failed, " << count_of(rows, RunOutcome::refused)
           << " refused\n";
    print_unfinished(stream, study, points, rows, RunOutcome::failed);
    print_unfinished(stream, study, points, rows, RunOutcome::refused);
    const auto reference = records.find(points.size());
    if (reference != records.end() && reference->second.outcome != RunOutcome::completed)
      stream << "  no errors: the reference is " << outcome_name(reference->second.outcome) << ": " << reference->second.reason
             << '\n';
    const Printer printer{ stream, study, points, rows };
    if (trade.measured.empty())
    {
      for (const auto &name : headlines(study.type))
        print_range(stream, printer, name);
      return;
    }
    stream << "  The cheapest settings, against " << reference_text(study) << " ("
           << formatted("%.3g", reference->second.cpu_time) << " s of CPU time):\n";
    if (in_full)
      for (const auto &measured : trade.measured)
        printer.accuracies(measured);
    else
    {
      printer.accuracies(trade.measured.back());
      printer.at_usual_accuracy(trade.measured);
    }
    print_orders(stream, trade.orders);
  }
} // namespace sprag
