// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "analytic/isolation.h"
#include "program/result_writer.h"
#include "results/entries.h"
#include "results/result_file.h"

#include <vector>

namespace sprag
{
  struct Scene;

  /// Lists the columns of the table of an isolation system.
  std::vector<ColumnInfo> isolation_columns();

  /// Returns the values of these columns; `is_before`: with the force just before a turn.
  std::vector<double> isolation_row(const IsolationSettings &settings, const IsolatedTable &motion, bool is_before);

  /// Writes and prints what a run of an isolation system found, with facts of the run.
  void finish_isolation(const Scene &scene, const IsolationFindings &found, const std::vector<Entry> &facts,
                        const std::string &status, ResultWriter &writer, Warnings &warnings);
} // namespace sprag
