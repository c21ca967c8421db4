// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "results/columns.h"
#include "scene/closed_form.h"

#include <functional>

namespace sprag
{
  struct Scene;

  /// Returns the row of a rigid lever in ideal contact: what follows from where the drive is and from the contact, 0 for what
  /// such a lever does not have.
  Row ideal_contact_row(const DrivePoint &point, const ClosedFormState &state, double spring_energy);

  /// Follows the closed form along the scene's drive, in steps of at most Analysis/Step; at every reversal two rows, before and
  /// after. The rows of a full pair are those of both levers. Works are integrated within each step, see work_between(). Requires
  /// a drive free of locking().
  void run_closed_form(const Scene &scene, const std::function<void(const Row &)> &sink);
} // namespace sprag
