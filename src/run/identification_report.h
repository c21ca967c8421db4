// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "analysis/identification/identification.h"
#include "results/result_file.h"

#include <iosfwd>
#include <vector>

namespace sprag
{
  struct Scene;

  std::vector<ColumnInfo> identification_columns(const MeasuredStroke &measured);

  /// Returns the rows of the columns, one a row of the measurement.
  std::vector<std::vector<double>> identification_rows(const MeasuredStroke &measured, const StrokeFit &fit,
                                                       const Identification &found);

  std::vector<Entry> identification_summary(const Scene &scene, const Identification &found);

  /// Returns the group /identification: names, values, deviations, correlation and singular values with their directions.
  std::vector<Group> identification_groups(const Identification &found);

  /// Returns the warnings that follow from what was found.
  Warnings identification_warnings(const Scene &scene, const Identification &found);

  void print_identification(std::ostream &stream, const Scene &scene, const Identification &found);
} // namespace sprag
