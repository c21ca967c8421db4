#pragma once

#include "analysis/run.h"

namespace sprag
{
  /// run() of Analysis/Type = sprag slip: growth of a perturbation beside its eigenvalue, the vibration it leads to, and where a
  /// stable slide and a vibration live side by side. Throws AnalysisError too where there is no slide to perturb and where the
  /// energy ledger leaves more open than Analysis/Maximum energy residual; what was finished is written then.
  void run_sprag_slip(const Scene &scene, const RunOptions &options, Warnings &warnings);
} // namespace sprag
