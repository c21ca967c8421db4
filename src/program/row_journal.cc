// SPDX-License-Identifier: GPL-3.0-only
#include "program/row_journal.h"

#include "base/child_process.h"
#include "base/errors.h"

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <fstream>
#include <iterator>
#include <unistd.h>

namespace sprag
{
  namespace
  {
    /// None where the blocks are not as they were written.
    std::optional<std::string> content_of(const std::string &blocks)
    {
      Archive archive(blocks);
      std::string result;
      try
      {
        while (!archive.at_end())
        {
          std::string block;
          archive(block);
          const auto content = unsealed(block);
          if (!content)
            return {};
          result += *content;
        }
      }
      catch (const AnalysisError &)
      {
        return {};
      }
      return result;
    }
  } // namespace

  RowJournal::RowJournal(std::string file_path)
      : path(std::move(file_path))
  {
  }

  RowJournal::~RowJournal()
  {
    ::close(file);
  }

  std::optional<std::string> RowJournal::take_up(const std::size_t size)
  {
    std::ifstream input(path, std::ios::binary);
    std::string blocks{ std::istreambuf_iterator<char>(input), {} };
    if (blocks.size() < size)
      return {};
    blocks.resize(size);
    auto result = content_of(blocks);
    if (!result)
      return {};
    file = ::open(path.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC);
    if (file < 0 || ::ftruncate(file, static_cast<off_t>(size)) != 0)
      return {};
    written = size;
    return result;
  }

  void RowJournal::write_block()
  {
    if (file < 0)
      file = ::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_APPEND | O_CLOEXEC, 0666);
    const std::string sum = checksum(pending.bytes());
    std::size_t length    = pending.bytes().size() + sum.size();
    Archive head;
    head(length);
    for (const auto *const part : { &head.bytes(), &pending.bytes(), &sum })
      if (file < 0 || !write_all(file, *part))
        return fail();
    written += head.bytes().size() + length;
    pending.clear();
  }

  void RowJournal::write()
  {
    write_block();
    if (::fdatasync(file) != 0)
      fail();
  }

  void RowJournal::fail()
  {
    const int reason = errno;
    static_cast<void>(!::ftruncate(file, static_cast<off_t>(written)));
    throw AnalysisError(path + " cannot be written: " + std::strerror(reason));
  }
} // namespace sprag
