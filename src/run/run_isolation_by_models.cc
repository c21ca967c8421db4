// SPDX-License-Identifier: GPL-3.0-only
#include "analysis/isolation/lever_table.h"
#include "levers/dynamics.h"
#include "program/isolation_report.h"
#include "run/analyses.h"
#include "run/in_memory.h"
#include "run/table_recorder.h"
#include "run/transient_settings.h"

#include <optional>

namespace sprag
{
  namespace
  {
    std::vector<Entry> facts_of(const LeverTable &table, const unsigned long steps_taken_over)
    {
      return { { "steps", static_cast<double>(table.number_of_steps()), "1", "accepted" },
               { "iterations_a_step", table.iterations_a_step(), "1", "ways of the table tried in a step" },
               { "steps_taken_over", static_cast<double>(steps_taken_over), "1", "from an interrupted run of the scene" } };
    }
  } // namespace

  void run_isolation_by_models(const Scene &scene, const RunOptions &options, Warnings &warnings)
  {
    require_folder(options);
    const auto maker   = dynamics_maker(options);
    const auto outward = maker->make(scene);
    const auto inward  = maker->make(scene);
    Checkpoint checkpoint(scene, options);
    TableRecorder recorder(scene, options, maker->timer(), checkpoint);
    RecordTable record;
    if (options.in_memory == nullptr)
      record = [&](const IsolatedTable &table, const bool is_before) { recorder.record(table, is_before); };

    std::optional<LeverTable> table;
    unsigned long steps_taken_over = 0;
    const TableKeeper keeper{ checkpoint, [&](Archive &archive)
                              {
                                visit(archive, *table);
                                if (archive.reads())
                                  steps_taken_over = table->number_of_steps();
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
          const std::vector<Entry> facts = table ? facts_of(*table, steps_taken_over) : std::vector<Entry>();
          finish_isolation(scene, options, found, facts, status, recorder.finish(), warnings);
          checkpoint.finish(status);
        });
  }
} // namespace sprag
