// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "results/columns.h"
#include "scene/closed_form.h"

#include <functional>

namespace sprag
{
  struct Scene;

  /// Returns the row of a rigid lever in ideal contact at a point of the drive; columns that such a lever lacks are 0.
  Row ideal_contact_row(const DrivePoint &point, const ClosedFormState &state, double spring_energy);

  /// Evaluates the closed form along the scene's drive in steps of at most Analysis/Step. A reversal gives two rows, before and
  /// after. The rows of a full pair hold both levers. Works are integrated within each step by work_between(). Requires a drive
  /// without locking().
  void run_closed_form(const Scene &scene, const std::function<void(const Row &)> &sink);
} // namespace sprag
