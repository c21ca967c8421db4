// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "analysis/identification/identification.h"

#include <vector>

namespace sprag
{
  /// Finds those of offsets, lag, scale of Q and cylinder radius each of which alone would explain the residuals but for noise,
  /// beside changes of the unknowns sought. `jacobian` is that of the residuals over `deviations`. Straight lines stand for the
  /// model: large changes are estimates.
  std::vector<OneMoreUnknown> more_unknowns(const Scene &scene, const StrokeFit &fit, const Identification &found,
                                            const std::vector<double> &deviations, const std::vector<double> &jacobian);
} // namespace sprag
