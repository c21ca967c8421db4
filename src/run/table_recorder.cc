// SPDX-License-Identifier: GPL-3.0-only
#include "run/table_recorder.h"

#include "base/text.h"
#include "program/isolation_report.h"
#include "scene/scene.h"

#include <cstdint>
#include <iostream>

namespace sprag
{
  namespace
  {
    enum class RecordKind : std::uint64_t
    {
      row
    };
  } // namespace

  TableRecorder::TableRecorder(const Scene &scene_, const RunOptions &options, PhaseTimer &timer, Checkpoint &checkpoint_)
      : scene(scene_)
      , checkpoint(checkpoint_)
      , writer(scene, options, timer, isolation_columns())
      , progress(std::cerr, progress_style(options.quiet || options.in_memory != nullptr), scene.isolation.duration)
  {
    if (checkpoint.resumes())
      take_over(options.quiet);
    checkpoint.set_records(
        [this](RowJournal &journal)
        {
          // Whatever append() throws, it has what it was given.
          while (kept < to_keep.size())
            journal.append(RecordKind::row, to_keep[kept++]);
          to_keep.clear();
          kept = 0;
        });
  }

  void TableRecorder::take_over(const bool quiet)
  {
    std::vector<double> row;
    std::size_t rows = 0;
    for (Archive records = checkpoint.recorded(); !records.at_end(); ++rows)
    {
      RecordKind kind{};
      records(kind, row);
      writer.append(row);
    }
    const double time = row.empty() ? 0. : row.front();
    progress.begin_at(time);
    if (!quiet)
      std::cout << "Goes on:      from t = " << rounded_text(time) << " s, row " << rows << " of an interrupted run\n"
                << std::flush;
  }

  void TableRecorder::record(const IsolatedTable &table, const bool is_before)
  {
    auto row = isolation_row(scene.isolation, table, is_before);
    checkpoint.hand_on([&] { writer.append(row); });
    if (checkpoint.keeps())
      to_keep.push_back(std::move(row));
    ProgressFields fields;
    fields.z = table.state().z;
    progress.update(table.state().time, fields);
  }

  ResultWriter &TableRecorder::finish()
  {
    progress.finish();
    return writer;
  }
} // namespace sprag
