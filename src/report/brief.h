// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "analytic/error_estimate.h"
#include "results/result_file.h"

#include <iosfwd>
#include <vector>

namespace sprag
{
  /// Prints of a run along a drive what a reader wants to know first: peaks, slopes, work, pressure, stress, the ringing behind
  /// each reversal, told errors and cost. Entries that are missing or unknown (NaN) leave no trace. All else is in /summary.
  void print_brief(std::ostream &stream, const std::vector<Entry> &summary, const std::vector<ErrorEstimate> &errors,
                   double cpu_seconds);
} // namespace sprag
