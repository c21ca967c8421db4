#pragma once

#include "analysis/run.h"

namespace sprag
{
  /// run() of Analysis/Type = transient: any model in time. Throws AnalysisError too where the energy ledger leaves more open
  /// than Analysis/Maximum energy residual.
  void run_transient_scene(const Scene &scene, const RunOptions &options, Warnings &warnings);
} // namespace sprag
