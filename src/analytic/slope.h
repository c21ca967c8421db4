// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "results/columns.h"

#include <vector>

namespace sprag
{
  struct Scene;

  /// A table of a sweep.
  struct Sweep
  {
    std::vector<ColumnInfo> columns;
    std::vector<std::vector<double>> rows;
  };

  /// Representative slope C_Q over mu from 0 to Slope/Maximum coefficient at the scene's geometry (Fig. 10): mu, slopes forward
  /// and backward [N/mm] and without dimension; or over th0 for each e/R of Slope/Offset ratios at the scene's mu, that of the
  /// drive's peak speed (Fig. 11): th0 [rad], e/R, slopes without dimension. The latter's curves break off at
  /// Slope/Maximum inclination or where the cylinder reaches the pivot, sin th0 = 1 - e/R, whichever comes first.
  Sweep slope_sweep(const Scene &scene);
} // namespace sprag
