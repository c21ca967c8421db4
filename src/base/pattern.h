// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include <string>

namespace sprag
{
  // Patterns are regular expressions of ECMAScript. The library's templates are instantiated here alone: each file that does so
  // takes 3 CPU seconds to compile.

  /// Returns whether all of a text follows a pattern.
  bool matches(const std::string &text, const std::string &pattern);

  /// Returns whether a part of a text follows a pattern.
  bool contains_match(const std::string &text, const std::string &pattern);

  /// Returns the text with each part that follows a pattern replaced; `$1` in the replacement stands for the first group.
  std::string replace_matches(const std::string &text, const std::string &pattern, const std::string &replacement);
} // namespace sprag
