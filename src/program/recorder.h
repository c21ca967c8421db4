// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "analytic/energy_ledger.h"
#include "base/progress.h"
#include "program/checkpoint.h"
#include "program/result_writer.h"
#include "report/report.h"
#include "scene/drive.h"

#include <functional>

namespace sprag
{
  struct Scene;

  /// Takes the rows of a run as they come: completes them, writes them, shows the progress and sums up at the end.
  class Recorder
  {
  public:
    /// Makes the folder and result file. Throws InputError if they cannot be written. With a checkpoint what is recorded goes
    /// there, too, and a run that goes on from it begins with what it holds.
    Recorder(const Scene &scene, const RunOptions &options, const PhaseTimer *timer = nullptr, const FacePoints &points = {},
             Checkpoint *checkpoint = nullptr);

    void record(const Row &row);

    void record(FaceState face);

    std::vector<Entry> stress;           ///< peaks for the summary, see StressPeaks; NaN of a model without a mesh
    std::vector<ErrorEstimate> accuracy; ///< estimated by the run

    /// Returns the rows so far.
    const std::vector<Row> &recorded() const
    {
      return rows;
    }

    /// Returns the number of steps that were recorded by an interrupted run.
    std::size_t steps_taken_over() const
    {
      return taken_over;
    }

    /// Writes and prints summary, meta and warnings, to which it adds those that follow from the rows. Status and meta: see
    /// ResultWriter. Finishes the checkpoint. Returns the summary.
    std::vector<Entry> finish(const std::string &status, std::vector<Entry> meta, Warnings &warnings);

  private:
    const Scene &scene;
    const bool quiet;
    ResultWriter writer;
    Progress progress;
    std::vector<Row> rows;
    double travel = 0.;

    Checkpoint *const checkpoint; ///< null without
    std::size_t taken_over = 0;

    void add(Row row);
    void take_over();
  };

  /// Returns the length of the drive's path [mm].
  double path_length(const Drive &drive);

  /// Runs `steps` of a scene in time, which returns its report, and checks its energy ledger; then completes and finishes the
  /// record whatever happened, with these facts of the model.
  void record_steps(
      const Scene &scene, Recorder &recorder, PhaseTimer &timer, Warnings &warnings, const std::vector<Entry> &facts,
      const std::function<TransientReport()> &steps, const std::function<void()> &complete = [] {});

  /// Prints what a run in time models, unless quiet.
  void announce_model(const Scene &scene, const RunOptions &options);
} // namespace sprag
