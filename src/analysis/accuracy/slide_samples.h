// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "analysis/statics/quasi_static.h"
#include "results/columns.h"

#include <functional>
#include <string>
#include <vector>

namespace sprag
{
  struct Scene;

  /// Rows of a run without inertia at which its errors are sampled, by increasing time: at most `number` of each of the first two
  /// strokes, evenly over the way on which the whole contact slides, where P and the pressure are largest, and those of `times`
  /// [s]. Empty where nothing slides.
  std::vector<Row> slide_samples(const std::vector<Row> &rows, unsigned int number, const std::vector<double> &times = {});

  /// Returns the rows from the first reversal, its own row included, to the largest P and Q behind it, as long as the contact has
  /// moved by less than its width: those that a stroke's largest values may come from and slide_samples() leave out. Empty
  /// without a reversal, or where that takes more rows than a trial run can pay.
  std::vector<Row> passage_rows(const std::vector<Row> &rows);

  /// Repeats a run's samples in another model, which slides from each to the next in a single step, or in parts of it where no
  /// equilibrium is found: sliding contact depends little on its history. Returns a row for each, and hands the states to `look`.
  /// `start` is where the run's drive began [mm]. Throws AnalysisError where the model cannot follow.
  std::vector<Row> repeated(
      Model &model, const std::vector<Row> &samples, double start, const QuasiStaticSettings &settings,
      const StepSink &look = [](const State &, const Row &, const Evaluation &) {});

  /// Returns the times of rows [s].
  std::vector<double> sample_times(const std::vector<Row> &rows);

  /// Returns the rows at one of some times, exactly.
  std::vector<Row> rows_at(const std::vector<double> &times, const std::vector<Row> &rows);

  /// Returns time, x and v of places in full sliding over the first two strokes of a drive, for trial runs before a run.
  std::vector<Row> drive_samples(const Drive &drive);

  /// Returns the same of the first reversal and of places behind it, up to a distance [mm], over which the contact turns: where P
  /// and Q of the way back are largest. Empty where the drive does not turn or ends before.
  std::vector<Row> places_behind_reversal(const Drive &drive, double distance);

  /// Returns the work of the drive over samples by the trapezoidal rule [N mm].
  double compute_drive_work(const std::vector<Row> &samples);

  /// Returns by how much a quantity without inertia changes between two models' rows of the same samples: P, Q and contact_width
  /// by the largest change over the largest value of the first model, largest_pressure likewise where it is at least half of
  /// that, largest_stress as the pressure which it follows, and loop_area, the work between the samples, by its own change.
  /// Throws std::out_of_range for other names.
  double relative_change(const std::string &quantity, const std::vector<Row> &samples, const std::vector<Row> &other);

  /// Returns by how much the largest P or Q behind a reversal changes between two models' rows of the same passage through stick,
  /// from where friction has turned, over the largest value of the first model; 0 for other quantities and without rows.
  double peak_change(const std::string &quantity, const std::vector<Row> &passage, const std::vector<Row> &other);

  /// Returns the largest Analysis/Step, at most a quarter of the drive's way [mm], with which rows represent the closed form of a
  /// scene without inertia to `error` > 0: P and Q by straight lines between rows, over their peaks, and with `wants_loop` also
  /// the work of the drive by the trapezoidal rule.
  double largest_row_spacing(const Scene &scene, double error, bool wants_loop);
} // namespace sprag
