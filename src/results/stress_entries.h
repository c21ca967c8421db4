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

  /// What they are.
  inline constexpr std::array<const char *, 3> stress_meanings{
    { "largest von Mises stress in the lever, the cells at the hub left out",
      "largest von Mises stress in the friction layer, the cells at the hub left out",
      "largest von Mises stress in the cells that the hub holds: at its corner the linear elastic stress is singular, and a "
      "finer mesh finds more" }
  };

  /// Returns the entries of a run that finds no stress.
  inline std::vector<Entry> no_stress_peaks(const std::string &reason)
  {
    const double missing = std::numeric_limits<double>::quiet_NaN();
    std::vector<Entry> result;
    for (const unsigned int i : { 0u, 1u })
      result.push_back({ stress_names[i], missing, "MPa", std::string(stress_meanings[i]) + "; not told: " + reason });
    return result;
  }
} // namespace sprag
