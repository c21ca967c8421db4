// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include <limits>

namespace sprag
{
  /// Stands for a value that was not found or does not exist.
  inline constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
} // namespace sprag
