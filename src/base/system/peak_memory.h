// SPDX-License-Identifier: GPL-3.0-only
#pragma once

namespace sprag
{
  /// Begins to look for the peak anew, where the system can (Linux).
  void reset_peak_memory();

  /// Returns the largest resident memory of the process since then, or since its beginning [bytes]; 0 where it is not told.
  double peak_memory();
} // namespace sprag
