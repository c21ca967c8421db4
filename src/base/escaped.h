// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include <string>

namespace sprag
{
  /// Returns the text with each control character as \xHH, its hexadecimal number.
  std::string printable(const std::string &text);

  /// Returns the text so that it is a value in a parameter file: printable, and with all that would be taken for a comment, a
  /// continued line, an escape or white space at an end as \xHH.
  std::string escaped(const std::string &text);

  /// Returns what a value of a parameter file means: the inverse of escaped().
  std::string unescaped(const std::string &text);
} // namespace sprag
