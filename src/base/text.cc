// SPDX-License-Identifier: GPL-3.0-only
#include "base/text.h"

#include "base/pattern.h"

#include <boost/algorithm/string/case_conv.hpp>
#include <boost/algorithm/string/predicate.hpp>
#include <boost/algorithm/string/split.hpp>
#include <boost/algorithm/string/trim.hpp>
#include <boost/algorithm/string/trim_all.hpp>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <numeric>
#include <sstream>

namespace sprag
{
  namespace
  {
    std::size_t edit_distance(const std::string &a, const std::string &b)
    {
      // Row i of the table of distances between the first i letters of a and the first j of b.
      std::vector<std::size_t> row(b.size() + 1);
      std::iota(row.begin(), row.end(), 0);
      for (std::size_t i = 1; i <= a.size(); ++i)
      {
        std::size_t diagonal = row[0];
        row[0]               = i;
        for (std::size_t j = 1; j <= b.size(); ++j)
        {
          const std::size_t replaced = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
          diagonal                   = row[j];
          row[j]                     = std::min({ replaced, row[j] + 1, row[j - 1] + 1 });
        }
      }
      return row.back();
    }

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

  std::string trim(const std::string &text)
  {
    return boost::algorithm::trim_copy(text, std::locale::classic());
  }

  std::vector<std::string> split(const std::string &text, const char delimiter)
  {
    std::vector<std::string> parts;
    const auto end = text.find_last_not_of(' ') + 1;
    for (std::size_t begin = 0, stop = 0; begin < end; begin = stop + 1)
    {
      stop = std::min(text.find(delimiter, begin), end);
      parts.push_back(boost::algorithm::trim_copy_if(text.substr(begin, stop - begin), [](const char c) { return c == ' '; }));
    }
    return parts;
  }

  std::vector<std::string> split_all(const std::string &text, const char delimiter)
  {
    std::vector<std::string> parts;
    boost::algorithm::split(parts, text, [delimiter](const char c) { return c == delimiter; });
    for (auto &part : parts)
      part = trim(part);
    return parts;
  }

  std::string single_spaced(const std::string &text)
  {
    return boost::algorithm::trim_fill_copy(text, " ", std::locale::classic());
  }

  std::string number_text(const double value)
  {
    std::array<char, 32> buffer;
    const auto result = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
    return std::string(buffer.data(), result.ptr);
  }

  std::optional<LeadingNumber> leading_number(const std::string &text)
  {
    const std::string all = trim(text);
    // from_chars, unlike strtod, heeds no locale, but knows no plus sign either.
    const std::size_t sign = all.size() > 1 && all[0] == '+' && all[1] != '-' ? 1 : 0;
    const char *const end  = all.data() + all.size();
    double value           = 0.;
    const auto result      = std::from_chars(all.data() + sign, end, value);
    if (result.ec != std::errc() || !std::isfinite(value))
      return std::nullopt;
    return LeadingNumber{ value, trim(std::string(result.ptr, end)) };
  }

  std::optional<double> number_alone(const std::string &text)
  {
    const auto number = leading_number(text);
    return number && number->rest.empty() ? std::make_optional(number->value) : std::nullopt;
  }

  bool may_separate_thousands(const std::string &text)
  {
    return contains_match(text, "(^|[^0-9.,])[1-9][0-9]{0,2}[.,][0-9]{3}(?![0-9])") && contains_match(text, "[0-9],[0-9]");
  }

  std::optional<std::string> comma_rule(const std::string &text)
  {
    const auto whole = leading_number(text);
    if (!whole || !contains_match(whole->rest, "^,[0-9]"))
      return std::nullopt;
    if (may_separate_thousands(text))
      return "with a decimal point and no separator of thousands";
    const auto pointed = replace_matches(trim(text), "^([^,]*),", "$1.");
    const bool is_one  = contains_match(leading_number(pointed)->rest, "^($|[^.,])");
    return "with a decimal point" + std::string(is_one ? ": did you mean '" + pointed + "'?" : "");
  }

  std::optional<std::string> list_comma_rule(const std::string &text)
  {
    const std::string between = "([0-9]),([0-9])";
    if (!contains_match(text, between))
      return std::nullopt;
    if (may_separate_thousands(text))
      return "must have a blank behind each comma between numbers, and no separator of thousands";
    const auto list   = replace_matches(text, "([0-9]),(?=[0-9])", "$1, ");
    const bool is_one = !contains_match(text, "[0-9]\\.[0-9]|,[0-9]+,[0-9]");
    return "must be '" + list + "'" + (is_one ? " for a list, or '" + replace_matches(text, between, "$1.$2") + "'" : "");
  }

  std::optional<std::string> nearest(const std::string &name, const std::vector<std::string> &candidates)
  {
    std::optional<std::string> best;
    std::size_t smallest                     = std::max<std::size_t>(name.size() / 2, 1) + 1;
    const auto lower                         = [](const std::string &text) { return boost::algorithm::to_lower_copy(text); };
    constexpr std::size_t shortest_beginning = 4;
    for (const auto &candidate : candidates)
    {
      const bool begins   = name.size() >= shortest_beginning && boost::starts_with(lower(candidate), lower(name));
      const auto distance = begins ? 1 : edit_distance(lower(name), lower(candidate));
      if (distance < smallest)
      {
        smallest = distance;
        best     = candidate;
      }
    }
    return best;
  }

  std::vector<std::string> split_lines(const std::string &text, const std::size_t width)
  {
    std::vector<std::string> lines;
    std::istringstream words(text);
    for (std::string word; words >> word;)
      if (!lines.empty() && lines.back().size() + 1 + word.size() <= width)
        lines.back() += " " + word;
      else
        lines.push_back(word);
    return lines;
  }

  std::string to_identifier(const std::string &name)
  {
    std::string result;
    for (const char c : name)
      result +=
          std::isalnum(static_cast<unsigned char>(c)) != 0 ? static_cast<char>(std::tolower(static_cast<unsigned char>(c))) : '_';
    return result;
  }

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
