// SPDX-License-Identifier: GPL-3.0-only
#include "base/system/open_file.h"

#include <cerrno>
#include <fcntl.h>
#include <sys/file.h>
#include <thread>
#include <unistd.h>
#include <utility>

namespace sprag
{
  bool write_all(const int file, const std::string &text)
  {
    for (std::size_t done = 0; done < text.size();)
    {
      const auto written = ::write(file, text.data() + done, text.size() - done);
      if (written < 0 && errno != EINTR)
        return false;
      done += written > 0 ? static_cast<std::size_t>(written) : 0;
    }
    return true;
  }

  OpenFile::OpenFile(const std::string &path, const int flags)
      : descriptor(::open(path.c_str(), flags | O_CLOEXEC, 0666))
  {
  }

  OpenFile::OpenFile(OpenFile &&other) noexcept
      : descriptor(std::exchange(other.descriptor, -1))
  {
  }

  OpenFile &OpenFile::operator=(OpenFile &&other) noexcept
  {
    std::swap(descriptor, other.descriptor);
    return *this;
  }

  OpenFile::~OpenFile()
  {
    if (is_open())
      ::close(descriptor);
  }

  bool OpenFile::lock(const std::chrono::milliseconds timeout) const
  {
    constexpr std::chrono::milliseconds pause(50);
    const auto end = std::chrono::steady_clock::now() + timeout;
    while (::flock(descriptor, LOCK_EX | LOCK_NB) != 0)
    {
      if (errno != EWOULDBLOCK || std::chrono::steady_clock::now() >= end)
        return false;
      std::this_thread::sleep_for(pause);
    }
    return true;
  }

  bool OpenFile::write(const std::string &text) const
  {
    return write_all(descriptor, text);
  }

  bool OpenFile::truncate(const std::size_t size) const
  {
    return ::ftruncate(descriptor, static_cast<off_t>(size)) == 0;
  }

  bool OpenFile::synchronise() const
  {
    return ::fdatasync(descriptor) == 0;
  }

  struct stat OpenFile::status() const
  {
    struct stat result = {};
    ::fstat(descriptor, &result);
    return result;
  }

  bool OpenFile::is_same_as(const OpenFile &other) const
  {
    const struct stat own = status(), others = other.status();
    return is_open() && other.is_open() && own.st_dev == others.st_dev && own.st_ino == others.st_ino;
  }
} // namespace sprag
