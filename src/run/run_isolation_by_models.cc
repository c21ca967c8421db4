// SPDX-License-Identifier: GPL-3.0-only
#include "analysis/isolation/lever_table.h"
#include "analysis/transient/transient.h"
#include "analytic/isolated_table.h"
#include "base/progress.h"
#include "base/text.h"
#include "levers/dynamics.h"
#include "program/checkpoint.h"
#include "program/isolation_report.h"
#include "program/result_writer.h"
#include "run/in_memory.h"
#include "run/run.h"
#include "scene/scene.h"

#include <iostream>
#include <optional>
#include <vector>

namespace sprag
{
  namespace
  {
    /// Writes the rows of an interrupted run, behind which the progress goes on.
    void take_over(Checkpoint &checkpoint, ResultWriter &writer, Progress &progress, const bool quiet)
    {
      std::vector<double> row;
      std::size_t rows = 0;
      for (Archive records = checkpoint.recorded(); !records.at_end(); ++rows)
      {
        records(row);
        writer.append(row);
      }
      const double time = row.empty() ? 0. : row.front();
      progress.begin_at(time);
      if (!quiet)
        std::cout << "Goes on:      from t = " << rounded_text(time) << " s, row " << rows << " of an interrupted run\n"
                  << std::flush;
    }

    std::vector<Entry> table_entries(const LeverTable &table, const unsigned long steps_taken_over)
    {
      return { { "steps", static_cast<double>(table.step_count()) },
               { "iterations_a_step", table.iterations_a_step() },
               { "steps_taken_over", static_cast<double>(steps_taken_over) } };
    }
  } // namespace

  void run_isolation_by_models(const Scene &scene, const RunOptions &options, Warnings &warnings)
  {
    const auto maker   = dynamics_maker(options);
    const auto outward = maker->make(scene);
    const auto inward  = maker->make(scene);
    Checkpoint checkpoint(scene, options);
    ResultWriter writer(scene, options, isolation_columns(), &maker->timer());
    Progress progress(std::cerr, progress_style(options.quiet || options.in_memory != nullptr), scene.isolation.duration);
    if (checkpoint.resumes())
      take_over(checkpoint, writer, progress, options.quiet);
    RecordTable record;
    if (options.in_memory == nullptr)
      record = [&](const IsolatedTable &table, const bool is_before)
      {
        auto row = isolation_row(scene.isolation, table, is_before);
        checkpoint.hand_on([&] { writer.append(row); });
        checkpoint.keep(row);
        ProgressFields fields;
        fields.z = table.state().z;
        progress.update(table.state().time, fields);
      };

    std::optional<LeverTable> table;
    unsigned long steps_taken_over = 0;
    const TableKeeper keeper{ checkpoint, [&](Archive &archive)
                              {
                                serialise(archive, *table);
                                if (archive.reads())
                                  steps_taken_over = table->step_count();
                              } };
    IsolationFindings found;
    finish_in_any_case(
        [&]
        {
          table.emplace(scene, outward.model(), inward.model(), transient_settings(scene, {}));
          run_isolation(scene, *table, found, record, &keeper);
        },
        [&](const std::string &status)
        {
          const std::vector<Entry> facts = table ? table_entries(*table, steps_taken_over) : std::vector<Entry>();
          progress.finish();
          finish_isolation(scene, found, facts, status, writer, warnings);
          checkpoint.finish(status);
        });
  }
} // namespace sprag
