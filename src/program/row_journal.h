// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "base/archive.h"

#include <optional>
#include <string>

namespace sprag
{
  /// What a run has recorded, in a file to which blocks with checksums are added, so that a checkpoint need not hold it.
  class RowJournal
  {
  public:
    /// Nothing is read or written yet.
    explicit RowJournal(std::string path);
    ~RowJournal();
    RowJournal &operator=(RowJournal &&) = delete;

    /// Begins with the first `size` bytes of the file, drops what follows and returns the records in them; none where they are
    /// not as they were written.
    std::optional<std::string> take_up(std::size_t size);

    /// Adds a record, written with the next block. Throws as write() does, where it writes one.
    template <class Kind, class Item>
    void append(Kind kind, Item &item)
    {
      pending(kind, item);
      if (pending.bytes().size() > block_size)
        write_block();
    }

    /// Hands what was added to the system's disk. Throws AnalysisError where it cannot; it is then still to be written.
    void write();

    /// Returns the size of the file [bytes].
    std::size_t size() const
    {
      return written;
    }

  private:
    static constexpr std::size_t block_size = 1024 * 1024; ///< what a processor's cache holds

    const std::string path;
    int file            = -1;
    std::size_t written = 0;
    Archive pending; ///< the next block

    void write_block();
    void fail();
  };
} // namespace sprag
