// SPDX-License-Identifier: GPL-3.0-only
#include "results/disk_reserve.h"

#include "base/errors.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>
#include <utility>

namespace sprag
{
  namespace
  {
    // Always left, so that a file which must not grow any more can still be closed.
    constexpr std::size_t margin = 512 * 1024;

    [[noreturn]] void fail(const std::string &path, const int reason)
    {
      throw AnalysisError("cannot write " + path + ": " + std::strerror(reason));
    }

    std::size_t size_of_file(const int descriptor)
    {
      struct stat status = {};
      fstat(descriptor, &status);
      return static_cast<std::size_t>(status.st_size);
    }
  } // namespace

  DiskReserve::DiskReserve(const std::string &file_path)
      : path(file_path)
      , descriptor(open(file_path.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0666))
  {
    if (descriptor < 0)
      fail(path, errno);
  }

  DiskReserve::DiskReserve(DiskReserve &&other) noexcept
      : path(std::move(other.path))
      , descriptor(std::exchange(other.descriptor, -1))
      , reserved(other.reserved)
  {
  }

  DiskReserve::~DiskReserve()
  {
    if (descriptor < 0)
      return;
    if (reserved > size_of_file(descriptor))
      static_cast<void>(!ftruncate(descriptor, static_cast<off_t>(size_of_file(descriptor))));
    close(descriptor);
  }

  void DiskReserve::cover(const std::size_t bytes)
  {
    const std::size_t needed = size_of_file(descriptor) + bytes + margin;
    if (needed <= reserved)
      return;
    reserve(needed + margin);
    reserved = needed + margin;
  }

  void DiskReserve::rename(const std::string &new_path)
  {
    if (::rename(path.c_str(), new_path.c_str()) != 0)
      fail(new_path, errno);
    path = new_path;
  }

  void DiskReserve::require_in_place() const
  {
    struct stat own = {}, found = {};
    ::fstat(descriptor, &own);
    if (::stat(path.c_str(), &found) != 0 || own.st_ino != found.st_ino || own.st_dev != found.st_dev)
      throw AnalysisError(path + " was removed or replaced while the run wrote it: its results are lost");
  }

  void DiskReserve::reserve(const std::size_t end) const
  {
    rlimit limit = {};
    if (getrlimit(RLIMIT_FSIZE, &limit) == 0 && end > limit.rlim_cur)
      fail(path, EFBIG);
    if (fallocate(descriptor, FALLOC_FL_KEEP_SIZE, 0, static_cast<off_t>(end)) != 0)
      if (errno == ENOSPC || errno == EDQUOT || errno == EFBIG)
        fail(path, errno);
  }

  void require_space(const std::string &path, const std::size_t bytes)
  {
    try
    {
      DiskReserve(path).cover(bytes);
    }
    catch (const AnalysisError &)
    {
      ::unlink(path.c_str());
      throw;
    }
  }
} // namespace sprag
