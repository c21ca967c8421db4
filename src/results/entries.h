// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "results/hdf5.h"
#include "results/result_file.h"

namespace sprag
{
  /// Returns the last entry of every summary: "completed" or what went wrong.
  inline Entry status_entry(const std::string &status)
  {
    return { "status", status, "", "completed, or why the run ended early" };
  }

  /// Adds a group of entries to an open file. Throws AnalysisError when HDF5 fails.
  void add_entries(const hdf5::Handle &file, const std::string &group, const std::vector<Entry> &entries);
} // namespace sprag
