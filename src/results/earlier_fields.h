// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include <functional>
#include <string>

namespace sprag
{
  /// Returns whether a file in a folder of results has a name that FieldFiles gives, of leaf springs of earlier versions
  /// included.
  bool is_field_file(const std::string &name);

  /// Removes the files of a folder that are named so.
  void remove_files(const std::string &folder, const std::function<bool(const std::string &)> &is_named_so);
} // namespace sprag
