// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "analysis/limit_cycle/continuation.h"
#include "results/result_file.h"

namespace sprag
{
  /// Results of a sprag-slip analysis; a part is empty while the run has not come to it.
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

  /// Returns the groups /growth and /continuation of the result file.
  std::vector<Group> sprag_slip_groups(const SpragSlip &found, const SpragSlipSettings &settings);
} // namespace sprag
