// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "analysis/statics/quasi_static.h"

#include <functional>
#include <vector>

namespace sprag
{
  /// Rows of a run without inertia at which its errors are sampled, by increasing time: at most `number` of each of the first two
  /// strokes, evenly over the way on which the whole contact slides, where P and the pressure are largest, and those of `times`
  /// [s]. Empty where nothing slides.
  std::vector<Row> slide_samples(const std::vector<Row> &rows, unsigned int number, const std::vector<double> &times = {});

  /// Returns the rows from the first reversal, its own row included, to the largest P and Q behind it, as long as the contact has
  /// moved by less than its width: those that a stroke's largest values may come from and slide_samples() leave out. Empty
  /// without a reversal, or where that takes more rows than a trial run can pay.
  std::vector<Row> passage_rows(const std::vector<Row> &rows);

  /// Repeats a run's samples in another model, which slides from each to the next in a single step, or in parts of it where no
  /// equilibrium is found: sliding contact remembers little. Returns a row for each, and hands the states to `look`. `start` is
  /// where the run's drive began [mm]. Throws AnalysisError where the model cannot follow.
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
} // namespace sprag
