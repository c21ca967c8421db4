// SPDX-License-Identifier: GPL-3.0-only
#include "base/pattern.h"

#include <map>
#include <regex>

namespace sprag
{
  namespace
  {
    /// Compiles each pattern once.
    const std::regex &compiled(const std::string &pattern)
    {
      static std::map<std::string, std::regex> all;
      const auto found = all.find(pattern);
      return found != all.end() ? found->second : all.emplace(pattern, pattern).first->second;
    }
  } // namespace

  bool matches(const std::string &text, const std::string &pattern)
  {
    return std::regex_match(text, compiled(pattern));
  }

  bool contains_match(const std::string &text, const std::string &pattern)
  {
    return std::regex_search(text, compiled(pattern));
  }

  std::string replace_matches(const std::string &text, const std::string &pattern, const std::string &replacement)
  {
    return std::regex_replace(text, compiled(pattern), replacement);
  }
} // namespace sprag
