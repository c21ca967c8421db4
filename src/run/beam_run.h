// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "results/columns.h"

#include <vector>

namespace sprag
{
  struct Scene;

  /// Returns the rows of a scene's run in time by its reduced lever, by a beam where it is meshed: a quick look at how it rings
  /// and how many steps it takes. Throws AnalysisError where the run fails.
  std::vector<Row> beam_run(Scene scene);
} // namespace sprag
