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
  /// the damper's force in phase with z and z'. X: `base_amplitude` [mm], w: `angular_frequency` [rad/s]. A = 0 is one of
  /// them if a(0)^2 + b(0)^2 >= (m w^2 X)^2: friction or a preload holds the table. A is sought up to the smaller of the damper's
  /// reach and 1000 X.
  std::vector<HarmonicBalance> harmonic_balance(const IsolationSystem &system, double base_amplitude, double angular_frequency);
} // namespace sprag
