// SPDX-License-Identifier: GPL-3.0-only
#include "fe/dynamics/basis_file.h"

#include "base/archive.h"
#include "base/errors.h"
#include "base/pattern.h"
#include "base/system/file_content.h"
#include "base/system/open_file.h"

#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <unistd.h>

namespace sprag
{
  namespace
  {
    /// Begins each file, before the key and the bytes.
    constexpr char signature[] = "sprag basis ";

    /// Bounds the size of all bases in a folder.
    constexpr std::uintmax_t most_bytes = std::uintmax_t(1) << 30;

    const std::string basis_name = R"(basis-[0-9a-f]{16}\.bin)", temporary_name = basis_name + R"(\.[0-9]+)";

    std::string cache_path(const std::string &folder, const std::string &key)
    {
      return folder + "/basis-" + key + ".bin";
    }

    /// Returns whether a file in the folder, and no link, has a name like ours.
    bool is_called(const std::string &name, const std::filesystem::directory_entry &entry)
    {
      std::error_code ignored;
      return matches(entry.path().filename().string(), name) &&
             entry.symlink_status(ignored).type() == std::filesystem::file_type::regular;
    }

    /// Returns whether a file was written here, by how it begins.
    bool holds_basis(const std::string &path)
    {
      std::string beginning(std::strlen(signature), '\0');
      std::ifstream(path, std::ios::binary).read(beginning.data(), static_cast<std::streamsize>(beginning.size()));
      return beginning == signature;
    }

    /// Removes bases that were used longest ago, until those that stay have no more than `most_bytes`.
    void prune(const std::string &folder)
    {
      std::multimap<std::filesystem::file_time_type, std::filesystem::directory_entry, std::greater<>> latest_first;
      std::error_code error;
      for (std::filesystem::directory_iterator entry(folder, error), end; entry != end; entry.increment(error))
        if (is_called(basis_name, *entry))
          latest_first.emplace(entry->last_write_time(error), *entry);
      std::uintmax_t sum = 0;
      for (const auto &[time, entry] : latest_first)
      {
        const auto size = entry.file_size(error);
        if (error)
          continue;
        if (sum + size <= most_bytes)
          sum += size;
        else if (holds_basis(entry.path().string()))
          std::filesystem::remove(entry.path(), error);
      }
    }
  } // namespace

  std::string cache_folder(const std::string &configured)
  {
    if (!configured.empty())
      return configured;
    if (const char *cache = std::getenv("XDG_CACHE_HOME"); cache != nullptr && *cache != '\0')
      return std::string(cache) + "/sprag";
    if (const char *home = std::getenv("HOME"); home != nullptr && *home != '\0')
      return std::string(home) + "/.cache/sprag";
    return {};
  }

  std::optional<std::string> load_basis(const std::string &folder, const std::string &key)
  {
    const std::string path = cache_path(folder, key), head = signature + key;
    try
    {
      const auto content = unsealed(read_whole_file(path, most_bytes));
      if (!content || content->compare(0, head.size(), head) != 0)
        return {};
      std::error_code ignored; // what was used is pruned last
      std::filesystem::last_write_time(path, std::filesystem::file_time_type::clock::now(), ignored);
      return content->substr(head.size());
    }
    catch (const InputError &)
    {
      return {};
    }
  }

  void remove_abandoned(const std::string &folder)
  {
    // A writer's lock follows the file's creation at once.
    constexpr std::chrono::seconds young(10);
    std::error_code ignored;
    for (std::filesystem::directory_iterator entry(folder, ignored), end; entry != end; entry.increment(ignored))
    {
      const auto written = entry->last_write_time(ignored);
      const bool old     = !ignored && std::filesystem::file_time_type::clock::now() - written > young;
      if (old && is_called(temporary_name, *entry))
        if (const OpenFile file(entry->path().string(), O_RDWR); file.is_open() && file.lock())
          std::filesystem::remove(entry->path(), ignored);
    }
  }

  std::string store_basis(const std::string &folder, const std::string &key, const std::string &bytes)
  {
    if (folder.empty())
      return "there is no cache folder";
    const std::string temporary = cache_path(folder, key) + "." + std::to_string(::getpid()); // each process writes to its own
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    std::filesystem::remove(temporary, error); // what is there is no process's any more, or a link
    const OpenFile writer(temporary, O_RDWR | O_CREAT | O_EXCL);
    if (!writer.is_open())
      return temporary + " cannot be made";
    writer.lock(); // until it is closed no process takes the file for abandoned
    std::string trouble;
    if (!writer.write(sealed(signature + key + bytes)))
      trouble = std::strerror(errno);
    else if (std::filesystem::rename(temporary, cache_path(folder, key), error); error)
      trouble = error.message();
    if (trouble.empty())
    {
      prune(folder);
      return {};
    }
    std::filesystem::remove(temporary, error);
    return temporary + " cannot be written: " + trouble;
  }
} // namespace sprag
