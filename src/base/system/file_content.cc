// SPDX-License-Identifier: GPL-3.0-only
#include "base/system/file_content.h"

#include "base/errors.h"
#include "base/system/open_file.h"

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <unistd.h>

namespace sprag
{
  namespace
  {
    constexpr char byte_order_mark[] = "\xef\xbb\xbf";

    // Messages of the following do not name the file.

    void check_size(const std::size_t size, const std::size_t largest)
    {
      const auto megabytes = [](const std::size_t bytes) { return std::to_string(bytes >> 20) + " MB"; };
      if (size > largest)
        throw InputError("has " + megabytes(size) + ": must have at most " + megabytes(largest));
    }

    OpenFile opened(const std::string &path, const std::size_t largest)
    {
      OpenFile file(path, O_RDONLY | O_NONBLOCK); // or a pipe would wait for its writer
      if (!file.is_open())
        throw InputError(errno == ENOENT ? "cannot be read" : std::string("cannot be read: ") + std::strerror(errno));
      const auto status = file.status();
      if (S_ISDIR(status.st_mode))
        throw InputError("is a folder: must be a file");
      if (!S_ISREG(status.st_mode))
        throw InputError("must be a file and no pipe or device");
      check_size(static_cast<std::size_t>(status.st_size), largest);
      return file;
    }

    std::string content(const OpenFile &file, const std::size_t largest)
    {
      std::string text;
      for (;;)
      {
        char bytes[65536];
        const auto count = ::read(file.number(), bytes, sizeof bytes);
        if (count < 0 && errno != EINTR)
          throw InputError(std::string("cannot be read: ") + std::strerror(errno));
        if (count == 0)
          return text;
        text.append(bytes, count > 0 ? static_cast<std::size_t>(count) : 0);
        check_size(text.size(), largest);
      }
    }
  } // namespace

  std::string reason_unreadable(const std::string &file, const std::size_t largest)
  {
    try
    {
      opened(file, largest);
      return {};
    }
    catch (const InputError &error)
    {
      return error.what();
    }
  }

  std::string read_whole_file(const std::string &file, const std::size_t largest)
  {
    try
    {
      std::string text = content(opened(file, largest), largest);
      if (text.rfind(byte_order_mark, 0) == 0)
        text.erase(0, std::strlen(byte_order_mark));
      return text;
    }
    catch (const InputError &error)
    {
      throw InputError(file + ": " + error.what());
    }
  }
} // namespace sprag
