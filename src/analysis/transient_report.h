#pragma once

#include "analysis/energy_ledger.h"
#include "results/result_file.h"
#include "scene/scene.h"

#include <string>
#include <vector>

namespace sprag
{
  /// What a run in time says of itself at its end: peaks, works and ledger, oscillations after each reversal, cost.
  std::vector<Entry> transient_summary(const Scene &scene, const std::vector<Row> &rows);

  /// What its oscillations warn of.
  Warnings transient_warnings(const Scene &scene, const std::vector<Row> &rows);

  /// One line each: what the run models and what it leaves out.
  std::vector<std::string> modelled(const Scene &scene);

  /// Throws AnalysisError where the ledger leaves more open than Analysis/Maximum energy residual, naming the term that moved.
  void check_ledger(const Scene &scene, const LedgerReport &ledger);
} // namespace sprag
