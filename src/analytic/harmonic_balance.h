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
    double transmissibility; ///< first harmonic of the table's acceleration over that of the base
  };

  /// Returns all solutions A, the smallest first, of ((K - m w^2) A + a(A))^2 + b(A)^2 = (m w^2 X)^2, with a and b the parts of
  /// the damper's force in phase with z and z'. X: `base_amplitude` [mm], w: `frequency` [rad/s]. Friction holds the table
  /// (A = 0) if b(0) >= m w^2 X. A is sought up to the damper's reach and 1000 X.
  std::vector<HarmonicBalance> harmonic_balance(const IsolationSystem &system, double base_amplitude, double frequency);
} // namespace sprag
