// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "analytic/energy_ledger.h"
#include "results/result_file.h"

#include <string>
#include <vector>

namespace sprag
{
  struct Scene;

  /// Sums up a run in time: peaks, works and energy ledger, oscillations after each reversal, cost.
  std::vector<Entry> transient_summary(const Scene &scene, const std::vector<Row> &rows);

  /// Returns the warnings that follow from the oscillations of a run in time.
  Warnings transient_warnings(const Scene &scene, const std::vector<Row> &rows);

  /// Tells what the run models and what it leaves out, in lines for people.
  std::vector<std::string> modelled(const Scene &scene);

  /// Throws AnalysisError where the ledger leaves more open than Analysis/Maximum energy residual, naming the term that moved.
  void check_ledger(const Scene &scene, const LedgerReport &ledger);
} // namespace sprag
