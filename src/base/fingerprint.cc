// SPDX-License-Identifier: GPL-3.0-only
#include "base/fingerprint.h"

#include "base/errors.h"
#include "base/system/file_content.h"
#include "base/text.h"

#include <cstring>
#include <filesystem>
#include <set>
#include <sstream>

namespace sprag
{
  namespace
  {
    namespace fs = std::filesystem;

    /// Returns whether the file can be read.
    bool add_file(const fs::path &file, Fingerprint &key, std::set<fs::path> &seen)
    {
      std::string content, part;
      try
      {
        content = read_whole_file(file, largest_mesh);
      }
      catch (const InputError &)
      {
        return false;
      }
      if (!seen.insert(fs::absolute(file).lexically_normal()).second)
        return true;
      key.add(content);
      std::istringstream parts(file.extension() == ".geo" ? content : "");
      for (bool quoted = false; std::getline(parts, part, '"'); quoted = !quoted)
        if (quoted && !part.empty())
          add_file(file.parent_path() / part, key, seen);
      return true;
    }
  } // namespace

  void Fingerprint::add(const double value)
  {
    add(&value, sizeof(value));
  }

  void Fingerprint::add(const std::string &text)
  {
    add(static_cast<double>(text.size()));
    add(text.data(), text.size());
  }

  void Fingerprint::add(const void *bytes, const std::size_t count)
  {
    // Eight bytes at a time where there are so many: fast enough for a hundred megabytes.
    const auto *data = static_cast<const unsigned char *>(bytes);
    std::size_t i    = 0;
    for (; i + 8 <= count; i += 8)
    {
      std::uint64_t word = 0;
      std::memcpy(&word, data + i, 8);
      hash = (hash ^ word) * 1099511628211u;
      hash ^= hash >> 29;
    }
    for (; i < count; ++i)
      hash = (hash ^ data[i]) * 1099511628211u;
  }

  std::string Fingerprint::text() const
  {
    return formatted("%016llx", static_cast<unsigned long long>(hash));
  }

  std::string content_fingerprint(const std::string &file)
  {
    Fingerprint key;
    std::set<fs::path> seen;
    return add_file(file, key, seen) ? key.text() : "unreadable";
  }

  const std::string &program_fingerprint()
  {
    static const std::string program = content_fingerprint("/proc/self/exe");
    return program;
  }
} // namespace sprag
