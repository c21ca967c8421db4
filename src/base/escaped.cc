// SPDX-License-Identifier: GPL-3.0-only
#include "base/escaped.h"

#include "base/text.h"

#include <cctype>

namespace sprag
{
  namespace
  {
    std::string escape(const char c)
    {
      return formatted("\\x%02x", static_cast<unsigned int>(static_cast<unsigned char>(c)));
    }

    bool is_control(const std::string &text, const std::size_t at)
    {
      const auto byte = [&](const std::size_t i) { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0; };
      // The second block of control characters has two bytes in UTF-8.
      const auto is_pair = [&](const std::size_t i) { return byte(i) == 0xc2 && byte(i + 1) >= 0x80 && byte(i + 1) < 0xa0; };
      return byte(at) < 32 || byte(at) == 127 || is_pair(at) || (at > 0 && is_pair(at - 1));
    }

    bool is_escape(const std::string &text, const std::size_t at)
    {
      return text[at] == '\\' && at + 3 < text.size() && text[at + 1] == 'x' &&
             std::isxdigit(static_cast<unsigned char>(text[at + 2])) != 0 &&
             std::isxdigit(static_cast<unsigned char>(text[at + 3])) != 0;
    }
  } // namespace

  std::string printable(const std::string &text)
  {
    std::string result;
    for (std::size_t i = 0; i < text.size(); ++i)
      result += is_control(text, i) ? escape(text[i]) : std::string(1, text[i]);
    return result;
  }

  std::string escaped(const std::string &text)
  {
    std::string result;
    for (std::size_t i = 0; i < text.size(); ++i)
    {
      const char c       = text[i];
      const bool is_end  = i == 0 || i + 1 == text.size();
      const bool ends_it = (c == ' ' && is_end) || (c == '\\' && i + 1 == text.size());
      const bool is_read = c == '#' || ends_it || is_escape(text, i) || is_control(text, i);
      result += is_read ? escape(c) : std::string(1, c);
    }
    return result;
  }

  std::string unescaped(const std::string &text)
  {
    std::string result;
    for (std::size_t i = 0; i < text.size(); ++i)
      if (is_escape(text, i))
      {
        result += static_cast<char>(std::stoi(text.substr(i + 2, 2), nullptr, 16));
        i += 3;
      }
      else
        result += text[i];
    return result;
  }
} // namespace sprag
