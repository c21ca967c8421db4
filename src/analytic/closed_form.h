// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "analytic/energy_ledger.h"
#include "results/columns.h"
#include "scene/closed_form.h"

#include <functional>
#include <vector>

namespace sprag
{
  struct Scene;

  /// Returns the row of a rigid lever in ideal contact at a point of the drive; columns that such a lever lacks are 0.
  Row ideal_contact_row(const DrivePoint &point, const ClosedFormState &state, double spring_energy);

  /// Limits the change of v in a step without inertia, over the drive's peak speed: mu may follow it.
  constexpr double largest_speed_change = 0.02;

  /// Evaluates the closed form along the scene's drive in steps of at most Analysis/Step and largest_speed_change. A reversal
  /// gives two rows, before and after. The rows of a full pair hold both levers. Works are integrated within each step by
  /// work_between(). Requires a drive without locking().
  void run_closed_form(const Scene &scene, const std::function<void(const Row &)> &sink);

  /// Follows a rigid lever that never leaves the cylinder along the drive in steps of Time/Step: theta and its rates follow from
  /// the drive, P = (J theta'' + k (theta - theta_0)) / (s + sigma mu e) (eq. 5). `inertia` is J [t mm^2]; 0 gives the closed
  /// form. At turning points two rows, before and after. Works are integrals over each step by Gauss' rule. Throws AnalysisError
  /// where the contact would have to pull.
  TransientReport run_ideal_contact(const Scene &scene, double inertia, const std::function<void(const Row &)> &sink);

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
