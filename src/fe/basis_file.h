#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace sprag
{
  /// Arrays by name.
  using StoredArrays = std::map<std::string, std::vector<double>>;

  /// Hash over numbers and texts (64-bit FNV-1a).
  class Fingerprint
  {
  public:
    void add(double value);
    void add(const void *bytes, std::size_t count);
    std::uint64_t value() const;
    std::string text() const;

  private:
    std::uint64_t hash = 14695981039346656037u;
  };

  /// Folder for stored bases: the given one or, if empty, `sprag` in the user's cache folder.
  std::string cache_folder(const std::string &given);

  /// What was stored under `key`; none if there is no such file or it is damaged.
  std::optional<StoredArrays> load_arrays(const std::string &folder, const std::string &key);

  /// Stores in one piece or not at all. Returns what prevented it, empty if nothing.
  std::string store_arrays(const std::string &folder, const std::string &key, const StoredArrays &arrays);
} // namespace sprag
