// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include <vector>

namespace sprag
{
  /// Returns, at each of the increasing x, the value of the parabola that fits the y within half a `width` > 0 of it best, with
  /// tricube weights: local regression (LOESS; Cleveland, J. Am. Stat. Assoc. 74 (1979) 829). Waves of one width keep 91 % of
  /// their height, of half a width 29 %. It is rounded to 1e-9 of the range of y, so that what is level stays so. Where fewer
  /// than four points are near, y stays as it is.
  std::vector<double> locally_fitted(const std::vector<double> &x, const std::vector<double> &y, double width);
} // namespace sprag
