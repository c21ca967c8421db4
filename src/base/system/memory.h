// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include <string>

namespace sprag
{
  /// Memory that a process can still have.
  struct AvailableMemory
  {
    double bytes = 0.;  ///< infinite if unknown
    std::string reason; ///< what sets the limit: "free on this machine", "left by the limit of the control group"
  };

  /// Returns the least of what is free on the machine, what the limits of the process's control groups (version 1 or 2) leave,
  /// and what its own limit of address space leaves. `root` stands before /proc and /sys.
  AvailableMemory available_memory(const std::string &root = "");

  /// Returns the bytes that are free on the disk of a folder; 0 for a file system in memory or if unknown.
  double bytes_free_on_disk(const std::string &folder);

  /// Begins to look for the peak anew, where the system can (Linux).
  void reset_peak_memory();

  /// Returns the largest resident memory of the process since then, or since its beginning [bytes]; 0 if unknown.
  double peak_memory();
} // namespace sprag
