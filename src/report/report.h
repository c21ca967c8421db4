// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "analytic/energy_ledger.h"
#include "results/result_file.h"
#include "results/warning.h"

#include <iosfwd>
#include <string>
#include <vector>

namespace sprag
{
  struct Scene;

  /// Fills the closed form's columns at the row's x and v, where the scene has a closed form there; of a full pair those of
  /// the first lever.
  void add_closed_form(const Scene &scene, Row &row);

  /// Sums up a run without inertia: peaks of P and Q each way, slopes C_Q of the rows near x = 0, loop area and friction
  /// work, largest deviations from the closed form relative to the stroke's peak (the first 2 mm after a reversal apart),
  /// penetration and cone violation, cost in iterations.
  std::vector<Entry> make_summary(const Scene &scene, const std::vector<Row> &rows);

  /// Adds what the levers of a full pair do differently, and their force across the path; nothing for a single lever.
  void add_pair(const std::vector<Row> &rows, std::vector<Entry> &entries);

  /// Prints the entries as a table for people.
  void print_summary(std::ostream &stream, const std::vector<Entry> &summary);

  /// Warns where P or Q of a summary is more than 20 % off the closed form.
  Warnings deviation_warnings(const std::vector<Entry> &summary);

  /// Throws AnalysisError where a run that ended is too far from the closed form, by more than Analysis/Maximum deviation.
  void check_deviation(const Scene &scene, const std::vector<Entry> &summary);

  /// Sums up a run in time: peaks, works and energy ledger, oscillations after each reversal, cost.
  std::vector<Entry> transient_summary(const Scene &scene, const std::vector<Row> &rows);

  /// Returns the warnings that follow from the oscillations of a run in time.
  Warnings transient_warnings(const Scene &scene, const std::vector<Row> &rows);

  /// Returns lines of text on what the run models and what it neglects.
  std::vector<std::string> modelled(const Scene &scene);

  /// Throws AnalysisError where the ledger leaves more open than Analysis/Maximum energy residual, naming the term that moved.
  void check_ledger(const Scene &scene, const LedgerReport &ledger);
} // namespace sprag
