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

  /// Returns rows of a quasi-static run at which its errors are sampled, by increasing time. For each of the first two strokes
  /// they are at most `number` rows equally spaced in full sliding, those with the largest P and pressure, and those at `times`
  /// [s]. Empty without full sliding.
  std::vector<Row> slide_samples(const std::vector<Row> &rows, unsigned int number, const std::vector<double> &times = {});

  /// Returns the rows from the first reversal to four rows behind the largest P and Q, which lie less than the contact's width
  /// away. slide_samples() leaves these out although a peak may lie there. Empty without a reversal or for more than 100 rows.
  std::vector<Row> passage_rows(const std::vector<Row> &rows);

  /// Solves another model at the drive points of samples and returns a row for each. It takes a single step between samples, or
  /// halves it if there is no equilibrium: sliding contact depends little on its history. `sink` receives each state, `start` is
  /// x at the beginning of the drive [mm]. Throws AnalysisError if there is no equilibrium.
  std::vector<Row> solve_at_samples(
      Model &model, const std::vector<Row> &samples, double start, const QuasiStaticSettings &settings,
      const StepSink &sink = [](const State &, const Row &, const Evaluation &) {});

  /// Returns the times of rows [s].
  std::vector<double> sample_times(const std::vector<Row> &rows);

  /// Returns the rows whose time equals one of `times` [s] exactly.
  std::vector<Row> rows_at(const std::vector<double> &times, const std::vector<Row> &rows);

  /// Returns time, x and v of six drive points in the sliding part of the first two strokes, for trial runs before a run.
  std::vector<Row> drive_samples(const Drive &drive);

  /// Returns time, x and v at the first reversal and behind it up to a distance [mm], over which friction changes its direction.
  /// Empty without a reversal or if the drive ends before.
  std::vector<Row> reversal_samples(const Drive &drive, double distance);

  /// Returns the work of the drive over samples by the trapezoidal rule [N mm].
  double compute_drive_work(const std::vector<Row> &samples);

  /// Returns the relative difference of a quantity between two models' rows at the same samples: max |b_i - a_i| / max |a_i| for
  /// P, Q and contact_width; for largest_pressure the root mean square of (b_i - a_i)/a_i times the cube of the contact's width
  /// over that at the peak, over samples with at least half of the largest; stresses as the pressure;
  /// loop_area by compute_drive_work(). Throws std::out_of_range for other names.
  double relative_change(const std::string &quantity, const std::vector<Row> &samples, const std::vector<Row> &other);

  /// Returns the difference of two models' peaks of P, Q or pressure behind a reversal, once friction has changed its direction,
  /// over the largest value; 0 without rows. Both have the rows of the same passage_rows().
  double peak_change(Column column, const std::vector<Row> &passage, const std::vector<Row> &other);

  /// Returns the largest Analysis/Step [mm], at most a quarter of the stroke, at which rows of the closed form have a relative
  /// error of at most `error` > 0: linear interpolation of P and Q and, if `has_loop`, the loop area by the trapezoidal rule,
  /// both at the drive's largest speed.
  double largest_row_spacing(const Scene &scene, double error, bool has_loop);
} // namespace sprag
