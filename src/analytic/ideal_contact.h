// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "analytic/energy_ledger.h"

#include <functional>

namespace sprag
{
  struct Scene;

  /// Follows a rigid lever that never leaves the cylinder along the drive in steps of Time/Step: theta and its rates follow from
  /// the drive, P = (J theta'' + k (theta - theta_0)) / (s + sigma mu e) (eq. 5). `inertia` is J [t mm^2]; 0 gives the closed
  /// form. At turning points two rows, before and after. Works are integrals over each step by Gauss' rule. Throws AnalysisError
  /// where the contact would have to pull.
  TransientReport run_ideal_contact(const Scene &scene, double inertia, const std::function<void(const Row &)> &sink);
} // namespace sprag
