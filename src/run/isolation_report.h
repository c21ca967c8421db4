#pragma once

#include "analysis/isolation/isolation.h"
#include "results/entries.h"
#include "results/result_file.h"
#include "run/result_writer.h"

#include <vector>

namespace sprag
{
  /// Lists the columns of the table of an isolation system.
  const std::vector<ColumnInfo> &isolation_columns();

  /// Returns the values of these columns; `is_before`: with the force just before a turn.
  std::vector<double> isolation_row(const IsolationSettings &settings, const IsolatedTable &motion, bool is_before);

  /// Sums up a run; with a harmonic base the harmonic balance stands beside it.
  std::vector<Entry> isolation_summary(const Scene &scene, const IsolationFindings &found);

  /// Follows a table, fills in what it finds, hands on what is recorded and returns facts of the run.
  using IsolationRun = std::function<std::vector<Entry>(IsolationFindings &found, const RecordTable &record)>;

  /// Carries out a run of an isolation system and writes and prints what it finds, whatever happens.
  void record_isolation(const Scene &scene, const RunOptions &options, PhaseTimer &timer, Warnings &warnings,
                        const IsolationRun &follow);

  /// Returns what a run of an isolation system warns of.
  Warnings isolation_warnings(const Scene &scene, const IsolationFindings &found);
} // namespace sprag
