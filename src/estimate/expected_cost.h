// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "program/resources.h"
#include "results/result_file.h"

#include <vector>

namespace sprag
{
  struct Scene;

  /// Estimates the CPU time of a scene's run on this machine, from the sizes of its parts and the times that such parts took
  /// where that was measured, by slowness(): right within a factor of 2 for runs along the drive, under a table, held slides,
  /// maps and studies, see tests/benchmarks/expected_cost.py. Steps in time are counted by a beam, which rings as finite elements
  /// do.
  ExpectedCost expected_cost(const Scene &scene);

  /// Counts the work of a run with this summary: CPU time where slowness() is 1, by the sizes of its parts and its Newton
  /// iterations [s]. It is the same each time the scene is run; NaN where nobody has measured such runs.
  double counted_work(const Scene &scene, const std::vector<Entry> &summary);
} // namespace sprag
