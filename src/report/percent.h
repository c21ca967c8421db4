// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "base/text.h"

namespace sprag
{
  /// Returns a relative error in per cent, with two digits.
  inline std::string percent(const double error)
  {
    return formatted("%.2g", 100. * error) + " %";
  }
} // namespace sprag
