// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "base/errors.h"
#include "base/phase_timer.h"
#include "program/output_folder.h"
#include "program/run_options.h"
#include "results/result_file.h"

#include <optional>
#include <utility>

namespace sprag
{
  struct Scene;

  /// The results of a run besides its rows, written at its end.
  struct RunEnd
  {
    std::vector<Entry> summary;
    std::vector<Entry> meta     = {}; ///< facts of the run's own; program, libraries and costs are added to them
    std::vector<Group> groups   = {};
    std::vector<Entry> accuracy = {};
  };

  /// Throws InputError where the folder of a run that writes files cannot serve; makes nothing.
  void require_folder(const RunOptions &options);

  /// The file result.h5 of a run of any type, from its first row to its summary, or what a run in memory keeps instead.
  class ResultWriter
  {
  public:
    /// Makes the folder and the file, which has /face where there are points. Throws InputError if they cannot be written. The
    /// timer is read at the end.
    ResultWriter(const Scene &scene, const RunOptions &options, PhaseTimer &timer, const std::vector<ColumnInfo> &columns,
                 const FacePoints &points = {});

    /// Appends a Row, a FaceState or the values of the columns.
    template <class Appended>
    void append(const Appended &appended)
    {
      if (file)
        file->append(appended);
      else
        keep(appended);
    }

    /// Writes everything that the run leaves and closes the file. `status` is "completed" or what went wrong, and becomes the
    /// last entry of the summary. Returns what was written, meta complete.
    RunEnd finish(const std::string &status, RunEnd end, const Warnings &warnings);

  private:
    PhaseTimer &timer;
    InMemory *const in_memory;
    const std::string chosen;
    const bool keeps_curve;
    std::optional<ResultFile> file;

    void keep(const Row &row);

    /// Nothing else is kept of a run in memory.
    template <class Appended>
    void keep(const Appended &)
    {
    }
  };

  /// Returns the status of a run that ends, which is that of an interrupted one where it was interrupted behind its last step.
  /// The caller is to throw that then.
  std::string status_at_end(const std::string &status);

  /// Runs `steps`, then calls finish(status) whatever happened: with "completed", or with the message of an AnalysisError, which
  /// is thrown again.
  template <class Steps, class Finish>
  void finish_in_any_case(const Steps &steps, const Finish &finish)
  {
    try
    {
      steps();
    }
    catch (const AnalysisError &error)
    {
      finish(error.what());
      throw;
    }
    finish("completed");
  }
} // namespace sprag
