// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "analytic/error_estimate.h"
#include "base/errors.h"
#include "base/phase_timer.h"
#include "program/output_folder.h"
#include "program/run_options.h"
#include "report/console_summary.h"
#include "results/result_file.h"
#include "results/warning.h"

#include <optional>
#include <utility>

namespace sprag
{
  struct Scene;

  /// The results of a run besides its rows, written at its end.
  struct RunEnd
  {
    std::vector<Entry> summary;               ///< unit and meaning follow from the tables of the pages, see SummaryRow
    std::vector<Entry> meta             = {}; ///< facts of the run's own; program, libraries and costs are added to them
    std::vector<Group> groups           = {};
    std::vector<ErrorEstimate> accuracy = {};
    std::vector<AnswerLine> answer      = {}; ///< before the lines of the summary
  };

  /// The file result.h5 of a run of any type, from its first row to its summary, or what a run in memory keeps instead.
  class ResultWriter
  {
  public:
    /// Makes the folder and the file, which has /face where there are points. Throws InputError if they cannot be written. The
    /// timer, of a run whose phases are timed, is read at the end.
    ResultWriter(const Scene &scene, const RunOptions &options, const std::vector<ColumnInfo> &columns,
                 const PhaseTimer *timer = nullptr, const FacePoints &points = {});

    /// Appends a Row, a FaceState or the values of the columns.
    template <class Appended>
    void append(const Appended &appended)
    {
      if (file)
        file->append(appended);
      else
        keep(appended);
    }

    /// Writes everything that the run leaves, closes the file and prints the summary, unless quiet. `status` is "completed" or
    /// what went wrong, and becomes the last entry of the summary. Warns where errors exceed the scene's target. Returns what
    /// was written, meta complete.
    RunEnd finish(const std::string &status, RunEnd end, Warnings &warnings);

  private:
    const Scene &scene;
    const RunOptions options;
    const PhaseTimer *const timer;
    std::optional<ResultFile> file;

    void keep(const Row &row);

    /// Nothing else is kept of a run in memory.
    template <class Appended>
    void keep(const Appended &)
    {
    }
  };

  /// Writes a text that a run leaves beside its results. Throws AnalysisError where that fails.
  void write_file(const std::string &path, const std::string &text);

  /// Runs `steps`, then always calls finish(status): with "completed", or with the message of an AnalysisError, which
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
