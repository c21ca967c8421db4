// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "results/columns.h"

#include <vector>

namespace sprag
{
  struct Scene;

  /// Returns how far the inertia of the levers changes P while they follow the drive, over the largest P of the rows: by the
  /// closed form J d^2(th)/dt^2 over the spring's moment (eq. 5 of the paper). The vibrations behind sudden reversals and at the
  /// start are none of it.
  double left_out_inertia(const Scene &scene, const std::vector<Row> &rows);
} // namespace sprag
