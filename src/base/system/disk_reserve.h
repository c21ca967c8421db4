// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "base/system/open_file.h"

#include <cstddef>
#include <string>

namespace sprag
{
  /// Disk space kept for a file that grows. HDF5 does not survive a write that fails half way, neither the process nor what was
  /// written before: so the end of the space has to be noticed ahead of it.
  class DiskReserve
  {
  public:
    /// Creates the file where there is none. Throws AnalysisError with the system's reason.
    explicit DiskReserve(const std::string &path);

    DiskReserve(DiskReserve &&other)       = default;
    DiskReserve &operator=(DiskReserve &&) = delete;

    /// Gives back what the file did not use.
    ~DiskReserve();

    /// Makes sure that the file can grow by this many bytes and be closed after; throws AnalysisError if it cannot. File systems
    /// that cannot reserve are taken at their word that there is space.
    void cover(std::size_t bytes);

    /// Gives the file another name, in place of a file that has it. Throws AnalysisError where that fails.
    void rename(const std::string &new_path);

    /// Throws AnalysisError if the file is no longer at its path: its folder, or the file itself, was removed or replaced.
    void require_in_place() const;

  private:
    std::string path;
    OpenFile file;
    std::size_t reserved = 0; ///< from the start of the file
  };

  /// Throws AnalysisError with the system's reason, and removes the file, if it cannot be created or not take that many bytes at
  /// present.
  void require_space(const std::string &path, std::size_t bytes);
} // namespace sprag
