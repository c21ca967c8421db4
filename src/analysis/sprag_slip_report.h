#pragma once

#include "analysis/continuation.h"
#include "results/result_file.h"

namespace sprag
{
  /// What is known of a scene's sprag-slip, as far as the run has come.
  struct SpragSlip
  {
    SlideStability slide;
    bool exact = true; ///< whether the eigenvalue leaves out nothing of the friction in time, see Growth
    std::optional<Growth> growth;
    std::optional<Settled> settled;
    double settled_begin = 0.;             ///< of the rows written of the vibration [s]
    std::vector<ContinuationPoint> points; ///< of the continuation
    std::optional<Coexistence> coexistence;
    LedgerReport ledger;
    unsigned long steps = 0;
  };

  std::vector<Entry> sprag_slip_summary(const SpragSlip &found);

  /// /growth and /continuation.
  std::vector<Group> sprag_slip_groups(const SpragSlip &found, const SpragSlipSettings &settings);
} // namespace sprag
