// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "analytic/table_motion.h"

#include <vector>

namespace sprag
{
  /// A motion z = A sin(w t + phi) that meets the balance of forces in its first harmonic.
  struct HarmonicBalance
  {
    double amplitude;        ///< A [mm]; 0: friction holds the table
    double transmissibility; ///< of the first harmonic
  };

  /// Returns all motions of one harmonic under a harmonic base of this amplitude [mm] and frequency [1/s], the smallest first:
  /// ((K - m w^2) A + a(A))^2 + b(A)^2 = (m w^2 X)^2 with the parts a and b of the damper's force in phase with z and z'. The
  /// table is held where b(0) is as large as the right side. Amplitudes beyond the damper's way or 1000 X are not looked for.
  std::vector<HarmonicBalance> harmonic_balance(const IsolationSystem &system, double base_amplitude, double frequency);
} // namespace sprag
