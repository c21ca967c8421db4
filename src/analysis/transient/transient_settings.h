// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "analysis/transient/growing_modes.h"
#include "analysis/transient/transient.h"
#include "results/columns.h"

#include <vector>

namespace sprag
{
  struct Scene;

  /// Returns the rows of a scene's run in time by its reduced lever, by a beam where it is meshed: a quick look at how it rings
  /// and how many steps it takes. Throws AnalysisError where the run fails.
  std::vector<Row> beam_run(Scene scene);

  /// Returns the settings of a scene's run in time, whose steps follow the vibrations that grow. Kept apart from what runs of
  /// formulas need, which load no library of linear algebra.
  TransientSettings transient_settings(const Scene &scene, const std::vector<GrowingMode> &growing = {});
} // namespace sprag
