// SPDX-License-Identifier: GPL-3.0-only
#include "run/study_report.h"

#include "base/append.h"
#include "base/text.h"
#include "base/unknown.h"
#include "scene/scene.h"
#include "scene/sections.h"

#include <boost/algorithm/string/join.hpp>

#include <algorithm>
#include <set>

namespace sprag
{
  namespace
  {
    bool has_numbers(const Rule &rule)
    {
      return rule.kind != Rule::Kind::choice && rule.kind != Rule::Kind::text && rule.kind != Rule::Kind::file;
    }

    /// Of a parameter that takes words: the place of each among its values.
    double number_of(const VariedParameter &varied, const std::size_t index, const bool numeric)
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
        table.numbers.push_back(dataset_of(rows, { identifier_of(varied.name), rule.unit.empty() ? "1" : rule.unit, meaning },
                                           [&](const StudyRecord *row)
                                           { return number_of(varied, points[row->run][i], numeric); }));
        TextDataset texts{ identifier_of(varied.name), varied.name, {} };
        for (const auto *row : rows)
          texts.values.push_back(varied.values[points[row->run][i]]);
        table.texts.push_back(texts);
      }
    }

    void add_costs(const std::vector<const StudyRecord *> &rows, StudyTable &table)
    {
      const auto add = [&](const ColumnInfo &info, const auto &value)
      { table.numbers.push_back(dataset_of(rows, info, [&](const StudyRecord *row) { return value(*row); })); };
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
          table.numbers.push_back(dataset_of(rows, { entry.name, entry.unit.empty() ? "1" : entry.unit, entry.description },
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

    /// Where names meet the first one counts.
    template <class Column, class Name>
    void drop_repeated(std::vector<Column> &columns, const Name &name)
    {
      std::set<std::string> seen;
      columns.erase(
          std::remove_if(columns.begin(), columns.end(), [&](const Column &column) { return !seen.insert(name(column)).second; }),
          columns.end());
    }
  } // namespace

  std::vector<const StudyRecord *> finished_rows(const std::vector<StudyPoint> &points, const StudyRecords &records)
  {
    std::vector<const StudyRecord *> rows;
    for (const auto &[run, record] : records)
      if (run < points.size())
        rows.push_back(&record);
    return rows;
  }

  const Entry *find_entry(const StudyRecord &record, const std::string &name)
  {
    const auto &summary = record.found.summary;
    const auto found    = std::find_if(summary.begin(), summary.end(), [&](const Entry &entry) { return entry.name == name; });
    return found == summary.end() ? nullptr : &*found;
  }

  std::size_t count_of(const std::vector<const StudyRecord *> &rows, const RunOutcome outcome)
  {
    return static_cast<std::size_t>(
        std::count_if(rows.begin(), rows.end(), [&](const StudyRecord *row) { return row->outcome == outcome; }));
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

  Group trade_group(const StudySettings &study, const std::vector<StudyPoint> &points, const StudyRecords &records,
                    const StudyTrade &trade)
  {
    const auto rows = finished_rows(points, records);
    Group group{ "trade", { { { "accuracy", "1", "relative error admitted" }, {}, {} } } };
    group.datasets.front().values.assign(recommended_accuracies.begin(), recommended_accuracies.end());
    for (const auto &measured : trade.measured)
    {
      const auto &name = measured.measure.name;
      Dataset run{
        { "run_" + name, "1", "the cheapest run that meets the accuracy, and with it those of smaller sizes; NaN: none" }, {}, {}
      };
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
    TextDataset of{ "order_of", "measure over size; the other settings", {} };
    for (const auto &[measure, parameter, others, order] : trade.orders)
    {
      orders.values.push_back(order);
      of.values.push_back(measure + " over " + parameter + (others.empty() ? "" : "; " + others));
    }
    group.datasets.push_back(orders);
    group.texts.push_back(of);
    return group;
  }

  Group reference_group(const StudyRecord &reference)
  {
    Group group{ "reference", { { { "cpu_time", "s", "of the reference" }, { reference.cpu_time }, {} } } };
    for (const auto &entry : reference.found.summary)
      if (const double *number = std::get_if<double>(&entry.value))
        group.datasets.push_back({ { entry.name, entry.unit.empty() ? "1" : entry.unit, entry.description }, { *number }, {} });
    return group;
  }

  std::vector<Entry> study_summary(const StudySettings &study, const std::vector<StudyPoint> &points, const StudyRecords &records)
  {
    const auto rows = finished_rows(points, records);
    double cpu      = 0.;
    for (const auto &[run, record] : records)
      cpu += record.cpu_spent;
    const auto number          = [&](const RunOutcome outcome) { return static_cast<double>(count_of(rows, outcome)); };
    std::vector<Entry> entries = { { "runs", static_cast<double>(points.size()), "1", "asked for, without the reference" },
                                   { "completed", number(RunOutcome::completed), "1", "of them" },
                                   { "failed", number(RunOutcome::failed), "1", "of them" },
                                   { "refused", number(RunOutcome::refused), "1", "of them" },
                                   { "cpu_time_of_runs", cpu, "s", "of all, the reference included" } };
    if (const auto reference = records.find(points.size()); reference != records.end())
      entries.push_back(
          { "reference",
            outcome_name(reference->second.outcome) + (reference->second.reason.empty() ? "" : ": " + reference->second.reason),
            "", "the run that the others are compared with: " + study.reference });
    return entries;
  }
} // namespace sprag
