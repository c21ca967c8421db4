// SPDX-License-Identifier: GPL-3.0-only
#include "base/pattern.h"

#include <regex>

namespace sprag
{
  bool matches(const std::string &text, const std::string &pattern)
  {
    return std::regex_match(text, std::regex(pattern));
  }

  bool contains_match(const std::string &text, const std::string &pattern)
  {
    return std::regex_search(text, std::regex(pattern));
  }

  std::string replace_matches(const std::string &text, const std::string &pattern, const std::string &replacement)
  {
    return std::regex_replace(text, std::regex(pattern), replacement);
  }
} // namespace sprag
