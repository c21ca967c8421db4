// SPDX-License-Identifier: GPL-3.0-only
#include "analysis/study/study_results.h"
#include "analysis/task_farm/task_farm.h"
#include "base/ranges.h"
#include "base/text.h"
#include "base/unknown.h"
#include "input/sections.h"
#include "program/result_writer.h"
#include "report/console_summary.h"
#include "report/summary_lines.h"
#include "results/page_tables.h"
#include "results/result_file.h"
#include "run/run.h"
#include "run/study_runs.h"
#include "scene/scene.h"

#include <boost/algorithm/string/join.hpp>
#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <iosfwd>
#include <iostream>
#include <map>
#include <ostream>
#include <set>
#include <string>
#include <vector>

namespace sprag
{
  namespace
  {
    using StudyRows = std::vector<const StudyRecord *>;

    /// A study and what it has found.
    struct StudyFindings
    {
      const StudySettings &study;
      const std::vector<StudyPoint> &points;
      const StudyRecords &records;
      const StudyTrade trade;
      StudyRows rows               = {};      ///< the finished runs without the reference
      const StudyRecord *reference = nullptr; ///< null where it is not finished, or there is none
    };

    StudyFindings make_findings(const StudySettings &study, const std::vector<StudyPoint> &points, const StudyRecords &records)
    {
      StudyFindings result{ study, points, records, compute_trade(study, points, records) };
      for (const auto &[run, record] : records)
        if (run < points.size())
          result.rows.push_back(&record);
        else
          result.reference = &record;
      return result;
    }

    /// Returns an entry of a run's summary, null where it has none of this name.
    const Entry *find_entry(const StudyRecord &record, const std::string &name)
    {
      return find_by(record.found.summary, &Entry::name, name);
    }

    template <class Value>
    Value entry_value(const StudyRecord &record, const std::string &name, const Value &otherwise)
    {
      const Entry *found = find_entry(record, name);
      return found != nullptr ? std::get<Value>(found->value) : otherwise;
    }

    ColumnInfo entry_column(const Entry &entry)
    {
      return { entry.name, entry.unit.empty() ? "1" : entry.unit, entry.description };
    }

    /// Returns the number of a value; of a parameter with words its index among the values.
    double varied_number(const VariedParameter &varied, const std::size_t index, const bool numeric)
    {
      const auto number = leading_number(varied.values[index]);
      return numeric ? (number ? number->value : unknown) : static_cast<double>(index);
    }

    void add_parameters(const StudyFindings &findings, Group &table)
    {
      SceneSettings settings;
      const auto declared = scene_parameters(settings);
      for (std::size_t i = 0; i < findings.study.varied.size(); ++i)
      {
        const auto &varied = findings.study.varied[i];
        const auto index   = [&](const StudyRecord *row) { return findings.points[row->run][i]; };
        const Rule &rule   = find_parameter(declared, varied.name)->rule;
        const bool numeric = is_number(rule) || rule.kind == Rule::Kind::numbers;
        const auto meaning = varied.name + (numeric ? "" : ": place among its values");
        table.datasets.push_back(
            make_dataset(findings.rows, { to_identifier(varied.name), rule.unit.empty() ? "1" : rule.unit, meaning },
                         [&](const StudyRecord *row) { return varied_number(varied, index(row), numeric); }));
        table.texts.push_back(make_texts(findings.rows, to_identifier(varied.name), varied.name,
                                         [&](const StudyRecord *row) { return varied.values[index(row)]; }));
      }
    }

    void add_costs(const StudyRows &rows, Group &table)
    {
      const auto add = [&](const std::string &name, const auto &value)
      {
        table.datasets.push_back(
            make_dataset(rows, page_column("study", name), [&](const StudyRecord *row) { return value(*row); }));
      };
      add("run", [](const StudyRecord &row) { return static_cast<double>(row.run); });
      add("outcome", [](const StudyRecord &row) { return static_cast<double>(row.outcome); });
      add("cpu_time", [](const StudyRecord &row) { return row.cpu_time; });
      add("cpu_time_spent", [](const StudyRecord &row) { return row.cpu_spent; });
      add("work", [](const StudyRecord &row) { return row.work; });
      add("wall_time", [](const StudyRecord &row) { return row.wall_time; });
      add("peak_memory", [](const StudyRecord &row) { return row.peak_memory; });
      add("warnings", [](const StudyRecord &row) { return static_cast<double>(row.warnings.size()); });
      table.texts = { make_texts(rows, "outcome", "how the run ended",
                                 [](const StudyRecord *row) { return enumerator_name(row->outcome); }),
                      make_texts(rows, "reason", "why it was not completed", [](const StudyRecord *row) { return row->reason; }),
                      make_texts(rows, "warnings", "their names",
                                 [](const StudyRecord *row) { return boost::algorithm::join(row->warnings, ", "); }) };
    }

    void add_errors(const StudyTrade &trade, Group &table)
    {
      for (const auto &measured : trade.measured)
      {
        const auto &name = measured.measure.name;
        table.datasets.push_back({ { "error_" + name, "1", measured.measure.meaning }, measured.errors, {} });
        table.datasets.push_back(make_dataset(measured.front, { "pareto_" + name, "1", "1: nobody cheaper is as exact" },
                                              [](const bool best) { return best ? 1. : 0.; }));
      }
    }

    /// Returns the summary entries of all runs, each name once, in the order of first occurrence.
    std::vector<Entry> all_entries(const StudyRows &rows)
    {
      std::vector<Entry> all;
      std::set<std::string> names;
      for (const auto *row : rows)
        for (const auto &entry : row->found.summary)
          if (names.insert(entry.name).second)
            all.push_back(entry);
      return all;
    }

    void add_summaries(const StudyRows &rows, Group &table)
    {
      for (const auto &entry : all_entries(rows))
        if (std::holds_alternative<double>(entry.value))
          table.datasets.push_back(make_dataset(rows, entry_column(entry),
                                                [&](const StudyRecord *row) { return entry_value(*row, entry.name, unknown); }));
        else
          table.texts.push_back(make_texts(rows, entry.name, entry.description,
                                           [&](const StudyRecord *row) { return entry_value(*row, entry.name, std::string()); }));
    }

    /// Drops columns whose name an earlier one has.
    template <class Column, class Name>
    void drop_repeated(std::vector<Column> &columns, const Name &name)
    {
      std::set<std::string> seen;
      columns.erase(
          std::remove_if(columns.begin(), columns.end(), [&](const Column &column) { return !seen.insert(name(column)).second; }),
          columns.end());
    }

    /// Returns the finished runs, a row each: parameters, costs, outcome, errors and the summaries of the runs; NaN where a run
    /// has no such number.
    Group study_table(const StudyFindings &findings)
    {
      Group table{ "runs", {} };
      add_costs(findings.rows, table);
      add_parameters(findings, table);
      add_errors(findings.trade, table);
      add_summaries(findings.rows, table);
      drop_repeated(table.datasets, [](const Dataset &column) { return column.info.name; });
      drop_repeated(table.texts, [](const TextDataset &column) { return column.name; });
      return table;
    }

    /// Returns the group /trade: the accuracies and for each measure the run that meets them at the least cost; the observed
    /// orders.
    Group trade_group(const StudyFindings &findings)
    {
      Group group{ "trade",
                   { make_dataset(recommended_accuracies, { "accuracy", "1", "relative error admitted" },
                                  [](const double accuracy) { return accuracy; }) } };
      for (const auto &measured : findings.trade.measured)
      {
        const auto &name = measured.measure.name;
        group.datasets.push_back(make_dataset(
            measured.recommended,
            { "run_" + name, "1", "the cheapest run that meets the accuracy, and with it those of smaller sizes; NaN: none" },
            [&](const auto &row) { return row ? static_cast<double>(findings.rows[*row]->run) : unknown; }));
        group.datasets.push_back(make_dataset(measured.recommended, { "cpu_time_" + name, "s", "of that run" },
                                              [&](const auto &row) { return row ? findings.rows[*row]->cpu_time : unknown; }));
        group.texts.push_back(make_texts(measured.recommended, "settings_" + name, "of that run",
                                         [&](const auto &row) {
                                           return row ? settings_text(findings.study, findings.points[findings.rows[*row]->run])
                                                      : "";
                                         }));
      }
      group.datasets.push_back(make_dataset(findings.trade.orders,
                                            { "order", "1", "p of error = C size^p, fitted over the runs" },
                                            [](const ObservedOrder &one) { return one.order; }));
      group.texts.push_back(
          make_texts(findings.trade.orders, "order_of", "measure over size; the other settings",
                     [](const ObservedOrder &one)
                     { return one.measure + " over " + one.parameter + (one.others.empty() ? "" : "; " + one.others); }));
      return group;
    }

    /// Returns the group /reference: the numbers of the reference's summary.
    Group reference_group(const StudyRecord &reference)
    {
      Group group{ "reference", { { { "cpu_time", "s", "of the reference" }, { reference.cpu_time }, {} } } };
      for (const auto &entry : reference.found.summary)
        if (const double *number = std::get_if<double>(&entry.value))
          group.datasets.push_back({ entry_column(entry), { *number }, {} });
      return group;
    }

    std::vector<Entry> study_summary(const StudyFindings &findings)
    {
      const double cpu  = sum_over(findings.records, [](const auto &record) { return record.second.cpu_spent; });
      const auto number = [&](const RunOutcome outcome)
      {
        return static_cast<double>(std::count_if(findings.rows.begin(), findings.rows.end(),
                                                 [&](const StudyRecord *row) { return row->outcome == outcome; }));
      };
      std::vector<Entry> entries = { { "runs", static_cast<double>(findings.points.size()) },
                                     { "completed", number(RunOutcome::completed) },
                                     { "failed", number(RunOutcome::failed) },
                                     { "refused", number(RunOutcome::refused) },
                                     { "cpu_time_of_runs", cpu } };
      if (const auto *reference = findings.reference; reference != nullptr)
        entries.push_back({ "reference",
                            enumerator_name(reference->outcome) + (reference->reason.empty() ? "" : ": " + reference->reason), "",
                            findings.study.reference });
      return entries;
    }

    constexpr std::size_t most_runs_printed = 5; ///< of those that failed, and of those that were refused
    constexpr std::size_t usual_accuracy    = 1; ///< of the recommended ones, 1 %
    const std::string all                   = "all";

    std::string setting_with_unit(const std::string &name, const std::string &value)
    {
      const auto unit = parameter_unit(name);
      return name + " = " + value + (unit == "1" ? "" : ' ' + unit);
    }

    std::string settings_with_units(const StudyFindings &findings, const std::size_t run)
    {
      const auto &point = findings.points[run];
      std::string text;
      for (std::size_t i = 0; i < point.size(); ++i)
      {
        const auto &varied = findings.study.varied[i];
        text += (i == 0 ? "" : ", ") + setting_with_unit(varied.name, varied.values[point[i]]);
      }
      return text;
    }

    std::string reference_text(const StudySettings &study)
    {
      const auto text = [](const VariedParameter &one) { return setting_with_unit(one.name, one.values.front()); };
      return boost::algorithm::join(mapped(study.reference_values, text), ", ");
    }

    std::string accuracy_text(const double accuracy)
    {
      return rounded_text(100. * accuracy) + " %";
    }

    void print_unfinished(std::ostream &stream, const StudyFindings &findings, const RunOutcome outcome)
    {
      std::size_t printed = 0;
      for (const auto *row : findings.rows)
        if (row->outcome == outcome && printed++ < most_runs_printed)
          stream << "  " << enumerator_name(outcome) << ": " << settings_with_units(findings, row->run) << ": " << row->reason
                 << '\n';
      if (printed > most_runs_printed)
        stream << "  ... and " << printed - most_runs_printed << " more " << enumerator_name(outcome) << '\n';
    }

    std::string run_text(const StudyFindings &findings, const MeasuredErrors &measured, const std::size_t accuracy)
    {
      const auto &row = measured.recommended[accuracy];
      if (!row)
        return "none";
      const auto &run = *findings.rows[*row];
      return settings_with_units(findings, run.run) + ": " + formatted("%.3g", run.cpu_time) + " s of CPU time, " +
             percent(measured.errors[*row]) + " off";
    }

    void print_accuracies(std::ostream &stream, const StudyFindings &findings, const MeasuredErrors &measured)
    {
      summary_line(stream, measured.measure.name, "");
      for (std::size_t i = 0; i < recommended_accuracies.size(); ++i)
        summary_line(stream, "  within " + accuracy_text(recommended_accuracies[i]), run_text(findings, measured, i));
    }

    void print_at_usual_accuracy(std::ostream &stream, const StudyFindings &findings)
    {
      summary_line(stream, "each alone within " + accuracy_text(recommended_accuracies[usual_accuracy]), "");
      for (const auto &measured : findings.trade.measured)
        if (measured.measure.name != all)
          summary_line(stream, "  " + measured.measure.name, run_text(findings, measured, usual_accuracy));
    }

    /// Prints the observed orders over each size: for each measure their range over all other settings.
    void print_orders(std::ostream &stream, const std::vector<ObservedOrder> &orders)
    {
      std::map<std::pair<std::string, std::string>, std::pair<double, double>> ranges;
      for (const auto &[measure, parameter, others, order] : orders)
      {
        auto &range = ranges.insert({ { parameter, measure }, { order, order } }).first->second;
        range       = { std::min(range.first, order), std::max(range.second, order) };
      }
      std::map<std::string, std::string> texts;
      for (const auto &[key, range] : ranges)
      {
        auto &text = texts[key.first];
        text += (text.empty() ? "" : ", ") + key.second + formatted(" %.2f", range.first) +
                (range.first < range.second ? formatted(" to %.2f", range.second) : "");
      }
      for (const auto &[parameter, text] : texts)
        summary_line(stream, "observed order", "over " + parameter + ": " + text);
    }

    /// Returns the names that the runs' summaries mark as main, those with a number up to 3.
    std::vector<std::string> main_entries(const StudyFindings &findings)
    {
      std::vector<std::string> names;
      for (const auto &entry : all_entries(findings.rows))
        if (const auto found = summary_row(findings.study.type, entry.name); found && found->is_main && found->number <= 3)
          names.push_back(entry.name);
      return names;
    }

    /// Adds the line of an entry's smallest and largest value, if any run has a number.
    void add_range(const StudyFindings &findings, const std::string &name, std::vector<AnswerLine> &lines)
    {
      struct Found
      {
        double value;
        std::string unit;
        std::size_t run;
      };
      std::vector<Found> found;
      for (const auto *row : findings.rows)
        if (const auto *const entry = find_entry(*row, name))
          if (const double *number = std::get_if<double>(&entry->value); number != nullptr && std::isfinite(*number))
            found.push_back({ *number, entry->unit, row->run });
      if (found.empty())
        return;
      // Peaks of a force that acts backward are negative, offsets lie on both sides of 0: the largest has the largest magnitude.
      const bool by_size = name.rfind("peak_", 0) == 0 || name == "residual_offset";
      const auto size    = [by_size](const Found &one) { return by_size ? std::abs(one.value) : one.value; };
      const auto [least, most] =
          std::minmax_element(found.begin(), found.end(), [&size](const Found &a, const Found &b) { return size(a) < size(b); });
      lines.push_back({ name, four_digits(least->value) + " to " + with_unit(most->value, most->unit) + ", least for " +
                                  settings_with_units(findings, least->run) + ", most for " +
                                  settings_with_units(findings, most->run) });
    }

    /// Returns the lines of /answer: the range of each main entry, or with a reference the cheapest settings for all together.
    std::vector<AnswerLine> study_lines(const StudyFindings &findings)
    {
      std::vector<AnswerLine> lines;
      if (findings.trade.measured.empty())
        for (const auto &name : main_entries(findings))
          add_range(findings, name, lines);
      else
        for (std::size_t i = 0; i < recommended_accuracies.size(); ++i)
          lines.push_back({ all + " within " + accuracy_text(recommended_accuracies[i]),
                            run_text(findings, findings.trade.measured.back(), i) });
      return lines;
    }

    /// Prints failed and refused runs and, with a reference, the cheapest settings for each accuracy: with `in_full` of each
    /// quantity, else of each at one accuracy, behind study_lines().
    void print_study(std::ostream &stream, const StudyFindings &findings, const bool in_full)
    {
      const auto &measured  = findings.trade.measured;
      const auto *reference = findings.reference;
      print_unfinished(stream, findings, RunOutcome::failed);
      print_unfinished(stream, findings, RunOutcome::refused);
      if (reference != nullptr && reference->outcome != RunOutcome::completed)
        stream << "  no errors: the reference is " << enumerator_name(reference->outcome) << ": " << reference->reason << '\n';
      if (measured.empty())
        return;
      stream << "  The cheapest settings, against " << reference_text(findings.study) << " ("
             << formatted("%.3g", reference->cpu_time) << " s of CPU time):\n";
      if (in_full)
        for (const auto &one : measured)
          print_accuracies(stream, findings, one);
      else
        print_at_usual_accuracy(stream, findings);
      print_orders(stream, findings.trade.orders);
    }

    std::vector<std::size_t> missing_runs(const StudyRuns &runs, const StudyRecords &records)
    {
      std::vector<std::size_t> missing;
      for (std::size_t run = 0; run < runs.size(); ++run)
        if (records.count(run) == 0)
          missing.push_back(run);
      return missing;
    }

    /// Warns of the warnings that the runs and the reference have, each name with the number of its runs.
    Warnings run_warnings(const StudyRecords &records)
    {
      std::map<std::string, unsigned int> counts;
      std::size_t warned = 0;
      for (const auto &[run, record] : records)
      {
        warned += record.warnings.empty() ? 0 : 1;
        for (const auto &name : record.warnings)
          ++counts[name];
      }
      if (counts.empty())
        return {};
      const auto texts = mapped(counts, [](const auto &count) { return count.first + " in " + std::to_string(count.second); });
      return { make_warning("runs_with_warnings",
                            { std::to_string(warned), std::to_string(records.size()), boost::algorithm::join(texts, ", ") }) };
    }

    void write_study(const Scene &scene, const RunOptions &options, const StudyRuns &runs, const StudyRecords &records,
                     const std::string &status, const std::vector<Entry> &meta, Warnings &warnings)
    {
      const auto findings = make_findings(scene.study, runs.points(), records);
      const auto table    = study_table(findings);
      ResultWriter writer(scene, options, mapped(table.datasets, &Dataset::info));
      for (std::size_t row = 0; row < table.datasets.front().values.size(); ++row)
        writer.append(mapped(table.datasets, [row](const Dataset &column) { return column.values[row]; }));
      std::vector<Group> groups = {
        { "runs", {}, table.texts },
        { "headlines", {}, { { "name", "columns of the table that say most", main_entries(findings) } } },
      };
      if (!findings.trade.measured.empty())
      {
        groups.push_back(trade_group(findings));
        groups.push_back(reference_group(*findings.reference));
      }
      append(warnings, run_warnings(records));
      writer.finish(status, { study_summary(findings), meta, groups, {}, study_lines(findings) }, warnings);
      if (!options.quiet)
        print_study(std::cout, findings, options.verbose);
    }
  } // namespace

  void run_study(const Scene &scene, const RunOptions &options, Warnings &warnings)
  {
    FarmProgress progress{ progress_style(options.quiet) };
    StudyRuns runs(scene);
    on_first_rank([&] { require_possible_runs(scene); });
    TaskFarm farm(scene, options, { "study", "runs", "made again" }, progress);
    progress.say("study: " + std::to_string(runs.size()) + " runs");
    StudyRecords records;
    const auto learn = [&](const std::string &line)
    {
      StudyRecord record;
      read_line(line, record);
      records[record.run] = record;
    };
    for (const auto &line : farm.taken_over())
      learn(line);
    const auto n_ranks = dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD);
    const auto groups  = runs.run_groups(missing_runs(runs, records), n_ranks);
    finish_in_any_case(
        [&]
        {
          farm.carry_out(
              groups, [&](const std::size_t run) { return to_line(runs.run(run)); }, learn);
        },
        [&](const std::string &status)
        {
          progress.bar.reset();
          const auto meta = farm.cost();
          on_first_rank([&] { write_study(scene, options, runs, records, status, meta, warnings); });
        });
    farm.remove_log();
  }
} // namespace sprag
