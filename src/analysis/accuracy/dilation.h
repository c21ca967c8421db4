#pragma once

#include "results/columns.h"
#include "scene/drive.h"

#include <vector>

namespace sprag
{
  /// Returns the largest change of P, over its peak, per relative change of the frequency with which it rings: a vibration that
  /// runs slower by a small share d lags d (t - t_r) behind, t_r the reversal before, or the beginning, so that P is off by
  /// d (t - t_r) times the rate of P - P_quasi_static. 0 of a motion that does not ring.
  double change_by_frequency(const std::vector<Row> &rows, const Drive &drive);
} // namespace sprag
