// SPDX-License-Identifier: GPL-3.0-only
#pragma once

namespace sprag
{
  struct Scene;

  /// Returns the largest Analysis/Step, at most a quarter of the drive's way [mm], with which rows represent the closed form of a
  /// scene without inertia to `error` > 0: P and Q by straight lines between rows, over their peaks, and with `wants_loop` also
  /// the work of the drive by the trapezoidal rule.
  double largest_row_spacing(const Scene &scene, double error, bool wants_loop);
} // namespace sprag
