// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include <string>

namespace sprag
{
  /// Explains a name. Of a section, or of a parameter "Section/Name", it writes the parameters with their defaults and
  /// documentation; capitals do not matter. Of an entry or column of results, or of a warning, it writes the rows of the tables
  /// that are built into the program. Throws InputError with the nearest name where there is none.
  std::string help_text(const std::string &name);
} // namespace sprag
