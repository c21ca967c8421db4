// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include <string>

namespace sprag
{
  /// Returns whether a file in a folder of results has a name that FieldFiles gives, of leaf springs of earlier versions
  /// included.
  bool is_field_file(const std::string &name);

  /// Removes what FieldFiles of any run left in a folder.
  void remove_field_files(const std::string &folder);
} // namespace sprag
