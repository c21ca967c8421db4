// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "results/columns.h"

#include <string>
#include <vector>

namespace sprag
{
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

  /// Returns by how much a row lies beside the line over x between two others, 0 where these have the same x.
  double distance_from_line(const Row &before, const Row &row, const Row &after, Column column);
} // namespace sprag
