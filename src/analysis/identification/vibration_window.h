// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "analysis/identification/intervals.h"

#include <utility>
#include <vector>

namespace sprag
{
  /// Returns the most that may be left out behind a turn: a quarter of the shortest stroke [mm].
  double largest_window(const MeasuredMotion &motion);

  struct VibrationWindow
  {
    double window; ///< [mm]
    bool is_full;  ///< residuals are still large where it ends for being the largest
  };

  /// Finds how far behind turns residuals are larger than noise: up to the last of groups of neighbouring rows, at least 8, whose
  /// mean square is more than what noise has once in 10^4 groups (F distribution). `residuals` are over the deviations of noise,
  /// those within the largest window too.
  VibrationWindow vibration_window(const StrokeFit &fit, const std::vector<std::pair<UsedValue, double>> &residuals,
                                   const std::vector<ChannelNoise> &noise, double largest);
} // namespace sprag
