// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include <optional>
#include <string>

namespace sprag
{
  /// Folder for stored bases: the given one or, if empty, `sprag` in the user's cache folder.
  std::string cache_folder(const std::string &configured);

  /// Returns the bytes that were stored under `key`; none if there is no such file or it is damaged.
  std::optional<std::string> load_basis(const std::string &folder, const std::string &key);

  /// Removes what processes that ended in the middle of storing have left in a folder: files that none keeps locked and that are
  /// older than 10 s. What cannot be removed stays.
  void remove_abandoned(const std::string &folder);

  /// Stores bytes in one piece or not at all, beside any number of processes that do the same, and removes the bases of the
  /// folder that were used longest ago until what stays has no more than 1 GiB. Returns what prevented storing, empty if nothing.
  std::string store_basis(const std::string &folder, const std::string &key, const std::string &bytes);
} // namespace sprag
