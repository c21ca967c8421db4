// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "laws/moment_law.h"

#include <cmath>

namespace sprag
{
  /// M = k phi + c phi^3, which cubic interpolation meets; phi in hundredths [rad].
  inline MomentLaw cubic_hardening(const double k, const double c, const int first, const int last)
  {
    std::vector<MomentLaw::Sample> samples;
    for (int i = first; i <= last; ++i)
    {
      const double turn = 0.01 * i;
      samples.push_back({ turn, k * turn + c * std::pow(turn, 3), k + 3. * c * turn * turn });
    }
    return MomentLaw(k, samples);
  }
} // namespace sprag
