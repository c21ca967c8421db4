// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "base/unknown.h"
#include "results/hdf5.h"
#include "results/result_file.h"

#include <array>

namespace sprag
{
  /// Returns the last entry of every summary: "completed" or what went wrong.
  inline Entry status_entry(const std::string &status)
  {
    return { "status", status, "", "completed, or why the run ended early" };
  }

  /// Adds a group of entries to an open file. Throws AnalysisError when HDF5 fails.
  void add_entries(const hdf5::Handle &file, const std::string &group, const std::vector<Entry> &entries);

  /// Names of the largest stresses of a run in /summary: in lever, layer, and the cells that the hub holds.
  inline constexpr std::array<const char *, 3> stress_names{ { "largest_lever_stress", "largest_layer_stress",
                                                               "largest_stress_at_hub" } };

  /// Returns the entries of a run that finds no stress.
  inline std::vector<Entry> no_stress_peaks(const std::string &reason)
  {
    return { { stress_names[0], unknown, "", "not told: " + reason }, { stress_names[1], unknown, "", "not told: " + reason } };
  }
} // namespace sprag
