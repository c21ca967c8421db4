// SPDX-License-Identifier: GPL-3.0-only
#include "analysis/team/team.h"
#include "base/progress.h"
#include "program/result_writer.h"
#include "program/run_files.h"
#include "report/report.h"
#include "run/analyses.h"
#include "run/study_print.h"
#include "run/study_report.h"
#include "run/study_runs.h"
#include "scene/scene.h"
#include "scene/scene_key.h"

#include <deal.II/base/mpi.h>

#include <ctime>
#include <iostream>
#include <optional>

namespace sprag
{
  namespace
  {
    namespace MPI = dealii::Utilities::MPI;

    void announce(const Journal &journal, const std::size_t runs, const ProgressStyle style)
    {
      if (const auto damaged = journal.damaged_lines(); damaged > 0)
        std::cerr << "study.journal: damaged lines dropped, their runs are made again: " << damaged << std::endl;
      if (style == ProgressStyle::quiet)
        return;
      if (journal.dropped())
        std::cerr << "study.journal is of another scene or build: begun anew" << std::endl;
      if (!journal.lines().empty())
        std::cerr << "study.journal: " << journal.lines().size() << " runs taken over" << std::endl;
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
    std::vector<Entry> cost_of_study(const std::size_t taken_over, const double wall_seconds)
    {
      const double cpu = MPI::sum(static_cast<double>(std::clock()) / CLOCKS_PER_SEC, MPI_COMM_WORLD);
      const auto ranks = static_cast<double>(MPI::n_mpi_processes(MPI_COMM_WORLD));
      return { { "ranks", ranks, "1", "processes" },
               { "runs_taken_over", static_cast<double>(taken_over), "1", "from the journal" },
               { "wall_time", wall_seconds, "s", "of the study" },
               { "cpu_time_all", cpu, "s", "of all processes" } };
    }

    void write_study(const Scene &scene, const RunOptions &options, const StudyRuns &runs, const StudyRecords &records,
                     const std::string &status, const std::vector<Entry> &meta, const Warnings &warnings)
    {
      const auto &points = runs.points();
      const auto trade   = trade_of(scene.study, points, records);
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
      std::vector<Group> groups = { { "runs", {}, table.texts } };
      if (!trade.measured.empty())
      {
        groups.push_back(trade_group(scene.study, points, records, trade));
        groups.push_back(reference_group(records.at(points.size())));
      }
      const auto end = writer.finish(status, { study_summary(scene.study, points, records), meta, groups }, warnings);
      if (options.verbose)
        print_summary(std::cout, end.summary);
      if (!options.quiet)
        print_study(std::cout, scene.study, points, records, trade, options.verbose);
    }
  } // namespace

  void run_study(const Scene &scene, const RunOptions &options, Warnings &warnings)
  {
    const double begin = monotonic_seconds();
    const auto style   = progress_style(options.quiet || !is_first_rank());
    StudyRuns runs(scene);
    std::optional<Journal> journal;
    on_first_rank(
        [&]
        {
          require_possible_runs(scene);
          prepare_folder(scene, options);
          journal.emplace(options.folder + '/' + study_journal_name, "study", scene_key(scene));
          announce(*journal, runs.size(), style);
        });
    std::optional<Progress> progress;
    const auto report = [&](const std::size_t done, const std::size_t wanted)
    {
      if (!progress)
        progress.emplace(std::cerr, style, static_cast<double>(wanted));
      progress->update(static_cast<double>(done), {});
    };
    Team team({ "study", unchanged_inputs(scene, "study"), report }, journal ? &*journal : nullptr);
    StudyRecords records;
    const auto learn = [&](const std::string &line)
    {
      const auto record   = record_of(line);
      records[record.run] = record;
    };
    for (const auto &line : team.taken_over())
      learn(line);
    const auto taken_over = records.size();
    const auto groups     = runs.groups_of(missing_runs(runs, records), MPI::n_mpi_processes(MPI_COMM_WORLD));
    finish_in_any_case(
        [&]
        {
          team.carry_out(
              groups, [&](const std::size_t run) { return line_of(runs.run(run)); }, learn);
        },
        [&](const std::string &status)
        {
          progress.reset();
          const auto meta = cost_of_study(taken_over, monotonic_seconds() - begin);
          on_first_rank([&] { write_study(scene, options, runs, records, status, meta, warnings); });
        });
    on_first_rank([&] { journal->remove(); });
  }
} // namespace sprag
