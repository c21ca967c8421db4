// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include <string>

namespace sprag
{
  // ANSI colours of what a terminal shows.
  inline constexpr const char *warning_colour = "33";
  inline constexpr const char *error_colour   = "31";

  /// Returns the text in a colour if the descriptor of its stream is a terminal's and the environment has no NO_COLOR.
  std::string coloured(const std::string &text, int descriptor, const char *colour);
} // namespace sprag
