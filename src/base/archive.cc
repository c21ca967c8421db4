// SPDX-License-Identifier: GPL-3.0-only
#include "base/archive.h"

#include "base/errors.h"
#include "base/fingerprint.h"

#include <cstring>

namespace sprag
{
  void Archive::raw(void *data, const std::size_t size)
  {
    if (!reading)
    {
      kept.append(static_cast<const char *>(data), size);
      return;
    }
    if (size > kept.size() - position)
      throw AnalysisError("an archive ends too early");
    if (size > 0)
      std::memcpy(data, kept.data() + position, size);
    position += size;
  }

  std::size_t Archive::transfer_size(std::size_t items)
  {
    raw(&items, sizeof(items));
    if (reading && items > kept.size() - position)
      throw AnalysisError("an archive ends too early");
    return items;
  }

  std::string sealed(const std::string &bytes)
  {
    return bytes + fingerprint(bytes);
  }

  std::optional<std::string> unsealed(const std::string &bytes)
  {
    const std::size_t length = fingerprint().size();
    if (bytes.size() < length)
      return {};
    std::string content = bytes.substr(0, bytes.size() - length);
    if (bytes.compare(content.size(), length, fingerprint(content)) != 0)
      return {};
    return content;
  }
} // namespace sprag
