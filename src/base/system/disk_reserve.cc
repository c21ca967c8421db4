// SPDX-License-Identifier: GPL-3.0-only
#include "base/system/disk_reserve.h"

#include "base/errors.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <sys/resource.h>
#include <unistd.h>

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

    std::size_t file_size(const OpenFile &file)
    {
      return static_cast<std::size_t>(file.status().st_size);
    }
  } // namespace

  DiskReserve::DiskReserve(const std::string &file_path)
      : path(file_path)
      , file(file_path, O_WRONLY | O_CREAT)
  {
    if (!file.is_open())
      fail(path, errno);
  }

  DiskReserve::~DiskReserve()
  {
    if (reserved > file_size(file))
      file.truncate(file_size(file));
  }

  void DiskReserve::cover(const std::size_t bytes)
  {
    const std::size_t needed = file_size(file) + bytes + margin, end = needed + margin;
    if (needed <= reserved)
      return;
    rlimit limit = {};
    if (getrlimit(RLIMIT_FSIZE, &limit) == 0 && end > limit.rlim_cur)
      fail(path, EFBIG);
    if (fallocate(file.number(), FALLOC_FL_KEEP_SIZE, 0, static_cast<off_t>(end)) != 0)
      if (errno == ENOSPC || errno == EDQUOT || errno == EFBIG)
        fail(path, errno);
    reserved = end;
  }

  void DiskReserve::rename(const std::string &new_path)
  {
    if (::rename(path.c_str(), new_path.c_str()) != 0)
      fail(new_path, errno);
    path = new_path;
  }

  void DiskReserve::require_in_place() const
  {
    if (!file.is_same_as(OpenFile(path, O_PATH)))
      throw AnalysisError(path + " was removed or replaced while the run wrote it: its results are lost");
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
