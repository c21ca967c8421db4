// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "analysis/transient/growing_modes.h"
#include "analysis/transient/transient.h"

namespace sprag
{
  struct Scene;

  /// Returns the settings of a scene's run in time, whose steps follow the vibrations that grow. Kept apart from what runs of
  /// formulas need, which load no library of linear algebra.
  TransientSettings transient_settings(const Scene &scene, const std::vector<GrowingMode> &growing = {});
} // namespace sprag
