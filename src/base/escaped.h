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

  /// ANSI colours of what a terminal shows.
  inline constexpr const char *warning_colour = "33";
  inline constexpr const char *error_colour   = "31";

  /// Returns the text in a colour if the descriptor of its stream is a terminal's and the environment has no NO_COLOR.
  std::string coloured(const std::string &text, int descriptor, const char *colour);
} // namespace sprag
