// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "analytic/isolated_table.h"
#include "base/progress.h"
#include "program/checkpoint.h"
#include "program/result_writer.h"

#include <vector>

namespace sprag
{
  struct Scene;

  /// Takes the rows of a table on levers in time as they come: writes them, hands them to the checkpoint and shows the progress.
  class TableRecorder
  {
  public:
    /// Makes the folder and result file and begins with the rows of an interrupted run. Throws InputError if they cannot be
    /// written. All must live as long.
    TableRecorder(const Scene &scene, const RunOptions &options, PhaseTimer &timer, Checkpoint &checkpoint);

    void record(const IsolatedTable &table, bool is_before);

    /// Ends the progress and returns the file for what the run leaves at its end.
    ResultWriter &finish();

  private:
    const Scene &scene;
    Checkpoint &checkpoint;
    ResultWriter writer;
    Progress progress;
    std::vector<std::vector<double>> to_keep; ///< rows for the checkpoint's journal
    std::size_t kept = 0;                     ///< of these, there already

    void take_over(bool quiet);
  };
} // namespace sprag
