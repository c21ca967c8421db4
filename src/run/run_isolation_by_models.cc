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
    /// Takes the rows of a table on levers in time as they come: writes them, hands them to the checkpoint and shows the
    /// progress.
    class TableRecorder
    {
    public:
      /// Makes the folder and result file and begins with the rows of an interrupted run. Throws InputError if they cannot be
      /// written. The arguments must outlive the recorder.
      TableRecorder(const Scene &scene_, const RunOptions &options, PhaseTimer &timer, Checkpoint &checkpoint_)
          : scene(scene_)
          , checkpoint(checkpoint_)
          , writer(scene, options, timer, isolation_columns())
          , progress(std::cerr, progress_style(options.quiet || options.in_memory != nullptr), scene.isolation.duration)
      {
        if (checkpoint.resumes())
          take_over(options.quiet);
      }

      void record(const IsolatedTable &table, const bool is_before)
      {
        auto row = isolation_row(scene.isolation, table, is_before);
        checkpoint.hand_on([&] { writer.append(row); });
        checkpoint.keep(row);
        ProgressFields fields;
        fields.z = table.state().z;
        progress.update(table.state().time, fields);
      }

      /// Ends the progress and returns the file for what the run leaves at its end.
      ResultWriter &finish()
      {
        progress.finish();
        return writer;
      }

    private:
      const Scene &scene;
      Checkpoint &checkpoint;
      ResultWriter writer;
      Progress progress;

      void take_over(const bool quiet)
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
    };

    std::vector<Entry> table_entries(const LeverTable &table, const unsigned long steps_taken_over)
    {
      return { { "steps", static_cast<double>(table.step_count()) },
               { "iterations_a_step", table.iterations_a_step() },
               { "steps_taken_over", static_cast<double>(steps_taken_over) } };
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
          finish_isolation(scene, found, facts, status, recorder.finish(), warnings);
          checkpoint.finish(status);
        });
  }
} // namespace sprag
