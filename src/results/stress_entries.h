// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "base/unknown.h"
#include "results/result_file.h"

#include <array>

namespace sprag
{
  /// Names of the largest stresses of a run in /summary: in lever, layer, and the cells that the hub holds.
  inline constexpr std::array<const char *, 3> stress_names{ { "largest_lever_stress", "largest_layer_stress",
                                                               "largest_stress_at_hub" } };

  /// Returns the entries of a run that finds no stress.
  inline std::vector<Entry> no_stress_peaks(const std::string &reason)
  {
    return { { stress_names[0], unknown, "", "not told: " + reason }, { stress_names[1], unknown, "", "not told: " + reason } };
  }
} // namespace sprag
