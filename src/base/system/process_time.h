// SPDX-License-Identifier: GPL-3.0-only
#pragma once

namespace sprag
{
  /// Returns the wall time since the process was started, the loading of its libraries included [s]; NaN if unknown.
  double wall_seconds();
} // namespace sprag
