#pragma once

#include "results/columns.h"

#include <vector>

namespace sprag
{
  /// Returns the rows between two times [s] up to the last in which P is off P_quasi_static by at least a tenth of its largest
  /// distance: those that ring.
  std::vector<Row> ringing_rows(const std::vector<Row> &rows, double begin, double end);

  /// Returns the largest change of P [N] per relative change of the frequency with which it rings since `time` [s]: a vibration
  /// that runs slower by a small share d lags d (t - time) behind, so that P is off by that times the rate of
  /// P - P_quasi_static. Without rows 0.
  double change_by_frequency(const std::vector<Row> &ringing, double time);
} // namespace sprag
