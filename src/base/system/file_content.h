// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include <cstddef>
#include <string>

namespace sprag
{
  /// Sizes that no scene, table or mesh needs [bytes].
  inline constexpr std::size_t largest_scene = std::size_t(16) << 20, largest_table = std::size_t(1) << 30,
                               largest_mesh = std::size_t(4) << 30;

  /// Returns why a file cannot be read, "is a folder: must be a file": it must be a regular one, no pipe and no device, and have
  /// at most `largest` bytes. Returns nothing where it can.
  std::string reason_unreadable(const std::string &file, std::size_t largest);

  /// Returns the content of a file, without a byte order mark (UTF-8) before it. Throws InputError where it cannot be read, or
  /// not to its end.
  std::string read_whole_file(const std::string &file, std::size_t largest);
} // namespace sprag
