// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include <chrono>
#include <string>
#include <sys/stat.h>

namespace sprag
{
  /// Writes a text to an open file or pipe; returns false, with the reason in errno, where that fails.
  bool write_all(int file, const std::string &text);

  /// A file or folder that is open as long as this lives. Where a call fails it returns false, with the reason in errno.
  class OpenFile
  {
  public:
    /// No file.
    OpenFile() = default;

    /// Opens the file at `path` with the flags of open(2), of which O_CLOEXEC is always set.
    OpenFile(const std::string &path, int flags);

    OpenFile(OpenFile &&other) noexcept;
    OpenFile &operator=(OpenFile &&other) noexcept;
    ~OpenFile();

    bool is_open() const
    {
      return descriptor >= 0;
    }

    /// Waits up to `timeout` for a lock that no other process has; kept until the file is closed. EWOULDBLOCK says that another
    /// process has it, other reasons that the file system has no locks.
    bool lock(std::chrono::milliseconds timeout = {}) const;

    bool write(const std::string &text) const;

    /// Cuts the file, or fills it with zeros, to `size` bytes.
    bool truncate(std::size_t size) const;

    /// Hands the content to the disk.
    bool synchronise() const;

    /// Returns what the system knows of the file; zeros where it is not open.
    struct stat status() const;

    /// Returns whether both are open and one and the same.
    bool is_same_as(const OpenFile &other) const;

    int number() const
    {
      return descriptor;
    }

  private:
    int descriptor = -1;
  };
} // namespace sprag
