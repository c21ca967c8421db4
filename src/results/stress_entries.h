// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "results/result_file.h"

#include <array>
#include <limits>

namespace sprag
{
  /// Names of the largest stresses of a run in /summary: in lever, layer, and the cells that the hub holds.
  inline constexpr std::array<const char *, 3> stress_names{ { "largest_lever_stress", "largest_layer_stress",
                                                               "largest_stress_at_hub" } };

  /// Returns the entries of a run that finds no stress.
  inline std::vector<Entry> no_stress_peaks(const std::string &reason)
  {
    const double missing = std::numeric_limits<double>::quiet_NaN();
    std::vector<Entry> result;
    for (const unsigned int i : { 0u, 1u })
      result.push_back({ stress_names[i], missing, "", "not told: " + reason });
    return result;
  }
} // namespace sprag
