// SPDX-License-Identifier: GPL-3.0-only
#include "analysis/study/study_trade.h"
#include "analysis/task_farm/task_farm.h"
#include "base/append.h"
#include "base/phase_timer.h"
#include "base/progress.h"
#include "base/text.h"
#include "base/unknown.h"
#include "input/scene_key.h"
#include "input/sections.h"
#include "program/result_writer.h"
#include "program/run_files.h"
#include "report/console_summary.h"
#include "report/summary_lines.h"
#include "results/result_file.h"
#include "run/analyses.h"
#include "run/study_runs.h"
#include "scene/scene.h"

#include <boost/algorithm/string/join.hpp>
#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <iosfwd>
#include <iostream>
#include <map>
#include <optional>
#include <ostream>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace sprag
{
  namespace
  {
    /// The finished runs of a study, a row each.
    struct StudyTable
    {
      std::vector<Dataset> numbers;   ///< parameters, costs, errors, the numbers of the runs' summaries; NaN where a run has none
      std::vector<TextDataset> texts; ///< parameters, outcome, reason, warnings, the texts of the summaries
    };

    /// Returns the finished runs of a study without its reference.
    std::vector<const StudyRecord *> finished_rows(const std::vector<StudyPoint> &points, const StudyRecords &records)
    {
      std::vector<const StudyRecord *> rows;
      for (const auto &[run, record] : records)
        if (run < points.size())
          rows.push_back(&record);
      return rows;
    }

    /// Returns the number of those with this outcome.
    std::size_t count_outcomes(const std::vector<const StudyRecord *> &rows, const RunOutcome outcome)
    {
      return static_cast<std::size_t>(
          std::count_if(rows.begin(), rows.end(), [&](const StudyRecord *row) { return row->outcome == outcome; }));
    }

    /// Returns an entry of a run's summary, null where it has none of this name.
    const Entry *find_entry(const StudyRecord &record, const std::string &name)
    {
      const auto &summary = record.found.summary;
      const auto found    = std::find_if(summary.begin(), summary.end(), [&](const Entry &entry) { return entry.name == name; });
      return found == summary.end() ? nullptr : &*found;
    }

    bool has_numbers(const Rule &rule)
    {
      return rule.kind != Rule::Kind::choice && rule.kind != Rule::Kind::text && rule.kind != Rule::Kind::file;
    }

    /// Number of a value. A parameter that takes words has the index among its values.
    double varied_number(const VariedParameter &varied, const std::size_t index, const bool numeric)
    {
      const auto number = leading_number(varied.values[index]);
      return numeric ? (number ? number->value : unknown) : static_cast<double>(index);
    }

    void add_parameters(const StudySettings &study, const std::vector<StudyPoint> &points,
                        const std::vector<const StudyRecord *> &rows, StudyTable &table)
    {
      SceneSettings settings;
      const auto declared = scene_parameters(settings);
      for (std::size_t i = 0; i < study.varied.size(); ++i)
      {
        const auto &varied = study.varied[i];
        const Rule &rule   = find_parameter(declared, varied.name)->rule;
        const bool numeric = has_numbers(rule);
        const auto meaning = varied.name + (numeric ? "" : ": place among its values");
        table.numbers.push_back(make_dataset(rows, { to_identifier(varied.name), rule.unit.empty() ? "1" : rule.unit, meaning },
                                             [&](const StudyRecord *row)
                                             { return varied_number(varied, points[row->run][i], numeric); }));
        TextDataset texts{ to_identifier(varied.name), varied.name, {} };
        for (const auto *row : rows)
          texts.values.push_back(varied.values[points[row->run][i]]);
        table.texts.push_back(texts);
      }
    }

    void add_costs(const std::vector<const StudyRecord *> &rows, StudyTable &table)
    {
      const auto add = [&](const ColumnInfo &info, const auto &value)
      { table.numbers.push_back(make_dataset(rows, info, [&](const StudyRecord *row) { return value(*row); })); };
      add({ "run", "1", "place among the runs of the study" },
          [](const StudyRecord &row) { return static_cast<double>(row.run); });
      add({ "outcome", "1", "0 completed, 1 failed, 2 refused" },
          [](const StudyRecord &row) { return static_cast<double>(row.outcome); });
      add({ "cpu_time", "s", "that the run takes alone, meshes and bases that it shares with others included" },
          [](const StudyRecord &row) { return row.cpu_time; });
      add({ "cpu_time_spent", "s", "that it took here" }, [](const StudyRecord &row) { return row.cpu_spent; });
      add({ "work", "s",
            "count of what the run takes alone, by which runs are ranked: CPU time on another machine, NaN: not counted" },
          [](const StudyRecord &row) { return row.work; });
      add({ "wall_time", "s", "that passed" }, [](const StudyRecord &row) { return row.wall_time; });
      add({ "peak_memory", "MiB", "largest resident memory of its process while it ran" },
          [](const StudyRecord &row) { return row.peak_memory; });
      add({ "warnings", "1", "number of warnings" },
          [](const StudyRecord &row) { return static_cast<double>(row.warnings.size()); });
      TextDataset outcome{ "outcome", "how the run ended", {} }, reason{ "reason", "why it was not completed", {} },
          warnings{ "warnings", "their names", {} };
      for (const auto *row : rows)
      {
        outcome.values.push_back(outcome_name(row->outcome));
        reason.values.push_back(row->reason);
        warnings.values.push_back(boost::algorithm::join(row->warnings, ", "));
      }
      append(table.texts, { outcome, reason, warnings });
    }

    void add_errors(const StudyTrade &trade, StudyTable &table)
    {
      for (const auto &measured : trade.measured)
      {
        const auto &name = measured.measure.name;
        table.numbers.push_back({ { "error_" + name, "1", measured.measure.meaning }, measured.errors, {} });
        table.numbers.push_back({ { "pareto_" + name, "1", "1: nobody cheaper is as exact" }, {}, {} });
        for (const bool best : measured.front)
          table.numbers.back().values.push_back(best ? 1. : 0.);
      }
    }

    /// All that any run tells, in the order in which it is met.
    std::vector<Entry> all_entries(const std::vector<const StudyRecord *> &rows)
    {
      std::vector<Entry> all;
      std::set<std::string> names;
      for (const auto *row : rows)
        for (const auto &entry : row->found.summary)
          if (names.insert(entry.name).second)
            all.push_back(entry);
      return all;
    }

    void add_summaries(const std::vector<const StudyRecord *> &rows, StudyTable &table)
    {
      for (const auto &entry : all_entries(rows))
        if (std::holds_alternative<double>(entry.value))
          table.numbers.push_back(make_dataset(rows, { entry.name, entry.unit.empty() ? "1" : entry.unit, entry.description },
                                               [&](const StudyRecord *row)
                                               {
                                                 const Entry *found = find_entry(*row, entry.name);
                                                 return found != nullptr ? std::get<double>(found->value) : unknown;
                                               }));
        else
        {
          TextDataset texts{ entry.name, entry.description, {} };
          for (const auto *row : rows)
          {
            const Entry *found = find_entry(*row, entry.name);
            texts.values.push_back(found != nullptr ? std::get<std::string>(found->value) : "");
          }
          table.texts.push_back(texts);
        }
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

    StudyTable study_table(const StudySettings &study, const std::vector<StudyPoint> &points, const StudyRecords &records,
                           const StudyTrade &trade)
    {
      const auto rows = finished_rows(points, records);
      StudyTable table;
      add_costs(rows, table);
      add_parameters(study, points, rows, table);
      add_errors(trade, table);
      add_summaries(rows, table);
      drop_repeated(table.numbers, [](const Dataset &column) { return column.info.name; });
      drop_repeated(table.texts, [](const TextDataset &column) { return column.name; });
      return table;
    }

    /// Returns the group /trade: the accuracies and for each measure the run that meets them at the least cost; the observed
    /// orders.
    Group trade_group(const StudySettings &study, const std::vector<StudyPoint> &points, const StudyRecords &records,
                      const StudyTrade &trade)
    {
      const auto rows = finished_rows(points, records);
      Group group{ "trade", { { { "accuracy", "1", "relative error admitted" }, {}, {} } } };
      group.datasets.front().values.assign(recommended_accuracies.begin(), recommended_accuracies.end());
      for (const auto &measured : trade.measured)
      {
        const auto &name = measured.measure.name;
        Dataset run{ { "run_" + name, "1",
                       "the cheapest run that meets the accuracy, and with it those of smaller sizes; NaN: none" },
                     {},
                     {} };
        Dataset cost{ { "cpu_time_" + name, "s", "of that run" }, {}, {} };
        TextDataset settings{ "settings_" + name, "of that run", {} };
        for (const auto &row : measured.recommended)
        {
          run.values.push_back(row ? static_cast<double>(rows[*row]->run) : unknown);
          cost.values.push_back(row ? rows[*row]->cpu_time : unknown);
          settings.values.push_back(row ? settings_text(study, points[rows[*row]->run]) : "");
        }
        append(group.datasets, { run, cost });
        group.texts.push_back(settings);
      }
      Dataset orders{ { "order", "1", "p of error = C size^p, fitted over the runs" }, {}, {} };
      TextDataset order_texts{ "order_of", "measure over size; the other settings", {} };
      for (const auto &[measure, parameter, others, order] : trade.orders)
      {
        orders.values.push_back(order);
        order_texts.values.push_back(measure + " over " + parameter + (others.empty() ? "" : "; " + others));
      }
      group.datasets.push_back(orders);
      group.texts.push_back(order_texts);
      return group;
    }

    /// Returns the group /reference: the numbers of the reference's summary.
    Group reference_group(const StudyRecord &reference)
    {
      Group group{ "reference", { { { "cpu_time", "s", "of the reference" }, { reference.cpu_time }, {} } } };
      for (const auto &entry : reference.found.summary)
        if (const double *number = std::get_if<double>(&entry.value))
          group.datasets.push_back({ { entry.name, entry.unit.empty() ? "1" : entry.unit, entry.description }, { *number }, {} });
      return group;
    }

    std::vector<Entry> study_summary(const StudySettings &study, const std::vector<StudyPoint> &points,
                                     const StudyRecords &records)
    {
      const auto rows = finished_rows(points, records);
      double cpu      = 0.;
      for (const auto &[run, record] : records)
        cpu += record.cpu_spent;
      const auto number          = [&](const RunOutcome outcome) { return static_cast<double>(count_outcomes(rows, outcome)); };
      std::vector<Entry> entries = { { "runs", static_cast<double>(points.size()) },
                                     { "completed", number(RunOutcome::completed) },
                                     { "failed", number(RunOutcome::failed) },
                                     { "refused", number(RunOutcome::refused) },
                                     { "cpu_time_of_runs", cpu } };
      if (const auto reference = records.find(points.size()); reference != records.end())
        entries.push_back(
            { "reference",
              outcome_name(reference->second.outcome) + (reference->second.reason.empty() ? "" : ": " + reference->second.reason),
              "", study.reference });
      return entries;
    }

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
        const auto unit    = parameter_unit(varied.name);
        text += (i == 0 ? "" : ", ") + varied.name + " = " + varied.values[point[i]] + (unit.empty() ? "" : ' ' + unit);
      }
      return text;
    }

    std::string reference_text(const StudySettings &study)
    {
      std::string text;
      for (const auto &[name, values] : study.reference_values)
        text += (text.empty() ? "" : ", ") + name + " = " + values.front() +
                (parameter_unit(name).empty() ? "" : ' ' + parameter_unit(name));
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
        summary_line(stream, measured.measure.name, "");
        for (std::size_t i = 0; i < recommended_accuracies.size(); ++i)
          summary_line(stream, "  within " + accuracy_text(recommended_accuracies[i]),
                       run_text(measured.recommended[i], measured));
      }

      void at_usual_accuracy(const std::vector<MeasuredErrors> &all_measured) const
      {
        summary_line(stream, "each alone within " + accuracy_text(recommended_accuracies[usual_accuracy]), "");
        for (const auto &measured : all_measured)
          if (measured.measure.name != all)
            summary_line(stream, "  " + measured.measure.name, run_text(measured.recommended[usual_accuracy], measured));
      }
    };

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
    std::vector<std::string> main_entries(const AnalysisType type, const StudyRows &rows)
    {
      std::vector<std::string> names;
      std::set<std::string> seen;
      for (const auto *row : rows)
        for (const auto &entry : row->found.summary)
          if (seen.insert(entry.name).second)
            if (const auto found = summary_row(type, entry.name); found && found->is_main && found->number <= 3)
              names.push_back(entry.name);
      return names;
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
      // Peaks of a force that acts backward are negative, offsets lie on both sides of 0: the largest has the largest magnitude.
      const bool by_size = name.rfind("peak_", 0) == 0 || name == "residual_offset";
      const auto size    = [by_size](const Found &one) { return by_size ? std::abs(one.value) : one.value; };
      const auto [least, most] =
          std::minmax_element(found.begin(), found.end(), [&size](const Found &a, const Found &b) { return size(a) < size(b); });
      const auto settings = [&printer](const Found &one) { return settings_with_units(printer.study, printer.points[one.run]); };
      summary_line(stream, name,
                   four_digits(least->value) + " to " + with_unit(most->value, most->unit) + ", least for " + settings(*least) +
                       ", most for " + settings(*most));
    }

    /// Prints how the runs of a study ended and, where there is a reference, the cheapest settings that meet accuracies: with
    /// `in_full` for each quantity, else for all at once and for each at one accuracy. Without a reference it prints between
    /// which values the results lie.
    void print_study(std::ostream &stream, const StudySettings &study, const std::vector<StudyPoint> &points,
                     const StudyRecords &records, const StudyTrade &trade, const bool in_full)
    {
      const auto rows = finished_rows(points, records);
      print_unfinished(stream, study, points, rows, RunOutcome::failed);
      print_unfinished(stream, study, points, rows, RunOutcome::refused);
      const auto reference = records.find(points.size());
      if (reference != records.end() && reference->second.outcome != RunOutcome::completed)
        stream << "  no errors: the reference is " << outcome_name(reference->second.outcome) << ": " << reference->second.reason
               << '\n';
      const Printer printer{ stream, study, points, rows };
      if (trade.measured.empty())
      {
        for (const auto &name : main_entries(study.type, rows))
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

    namespace MPI = dealii::Utilities::MPI;

    void announce(const ResultsLog &results_log, const std::size_t runs, const ProgressStyle style)
    {
      if (const auto damaged = results_log.damaged_lines(); damaged > 0)
        std::cerr << "study.journal: damaged lines dropped, their runs are made again: " << damaged << std::endl;
      if (style == ProgressStyle::quiet)
        return;
      if (results_log.dropped())
        std::cerr << "study.journal is of another scene or build: begun anew" << std::endl;
      if (!results_log.lines().empty())
        std::cerr << "study.journal: " << results_log.lines().size() << " runs taken over" << std::endl;
      std::cerr << "study: " << runs << " runs" << std::endl;
    }

    std::vector<std::size_t> missing_runs(const StudyRuns &runs, const StudyRecords &records)
    {
      std::vector<std::size_t> missing;
      for (std::size_t run = 0; run < runs.size(); ++run)
        if (records.count(run) == 0)
          missing.push_back(run);
      return missing;
    }

    /// All ranks call it.
    std::vector<Entry> study_cost(const std::size_t taken_over, const double wall_seconds)
    {
      const double cpu = MPI::sum(static_cast<double>(std::clock()) / CLOCKS_PER_SEC, MPI_COMM_WORLD);
      const auto ranks = static_cast<double>(MPI::n_mpi_processes(MPI_COMM_WORLD));
      return { { "ranks", ranks },
               { "runs_taken_over", static_cast<double>(taken_over) },
               { "wall_time", wall_seconds },
               { "cpu_time_all", cpu } };
    }

    void write_study(const Scene &scene, const RunOptions &options, const StudyRuns &runs, const StudyRecords &records,
                     const std::string &status, const std::vector<Entry> &meta, Warnings &warnings)
    {
      const auto &points = runs.points();
      const auto trade   = compute_trade(scene.study, points, records);
      const auto table   = study_table(scene.study, points, records, trade);
      std::vector<ColumnInfo> columns;
      for (const auto &column : table.numbers)
        columns.push_back(column.info);
      PhaseTimer timer;
      ResultWriter writer(scene, options, timer, columns);
      for (std::size_t row = 0; row < table.numbers.front().values.size(); ++row)
      {
        std::vector<double> values;
        for (const auto &column : table.numbers)
          values.push_back(column.values[row]);
        writer.append(values);
      }
      const auto main_columns   = main_entries(scene.study.type, finished_rows(points, records));
      std::vector<Group> groups = {
        { "runs", {}, table.texts },
        { "headlines", {}, { { "name", "columns of the table that say most", main_columns } } },
      };
      if (!trade.measured.empty())
      {
        groups.push_back(trade_group(scene.study, points, records, trade));
        groups.push_back(reference_group(records.at(points.size())));
      }
      writer.finish(status, { study_summary(scene.study, points, records), meta, groups }, warnings);
      if (!options.quiet)
        print_study(std::cout, scene.study, points, records, trade, options.verbose);
    }
  } // namespace

  void run_study(const Scene &scene, const RunOptions &options, Warnings &warnings)
  {
    const double begin = monotonic_seconds();
    const auto style   = progress_style(options.quiet || !is_first_rank());
    StudyRuns runs(scene);
    std::optional<ResultsLog> results_log;
    on_first_rank(
        [&]
        {
          require_possible_runs(scene);
          prepare_folder(scene, options);
          results_log.emplace(options.folder + '/' + study_log_name, "study", scene_key(scene));
          announce(*results_log, runs.size(), style);
        });
    std::optional<Progress> progress;
    const auto report = [&](const std::size_t done, const std::size_t total)
    {
      if (!progress)
        progress.emplace(std::cerr, style, static_cast<double>(total));
      progress->update(static_cast<double>(done), {});
    };
    TaskFarm farm({ "study", unchanged_inputs(scene, "study"), report }, results_log ? &*results_log : nullptr);
    StudyRecords records;
    const auto learn = [&](const std::string &line)
    {
      StudyRecord record;
      read_line(line, record);
      records[record.run] = record;
    };
    for (const auto &line : farm.taken_over())
      learn(line);
    const auto taken_over = records.size();
    const auto groups     = runs.run_groups(missing_runs(runs, records), MPI::n_mpi_processes(MPI_COMM_WORLD));
    finish_in_any_case(
        [&]
        {
          farm.carry_out(
              groups, [&](const std::size_t run) { return to_line(runs.run(run)); }, learn);
        },
        [&](const std::string &status)
        {
          progress.reset();
          const auto meta = study_cost(taken_over, monotonic_seconds() - begin);
          on_first_rank([&] { write_study(scene, options, runs, records, status, meta, warnings); });
        });
    on_first_rank([&] { results_log->remove(); });
  }
} // namespace sprag
