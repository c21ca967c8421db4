// SPDX-License-Identifier: GPL-3.0-only
#include "results/warning.h"

#include "base/system/coloured.h"
#include "results/page_tables.h"

#include <boost/algorithm/string/replace.hpp>

#include <algorithm>
#include <sstream>
#include <stdexcept>
#include <unistd.h>

namespace sprag
{
  namespace
  {
    constexpr std::size_t line_length = 100;

    /// `text` behind a label, its further lines below its first word.
    std::string paragraph(const std::string &label, const std::string &text)
    {
      std::string result, line = label;
      std::istringstream words(text);
      for (std::string word; words >> word;)
      {
        if (line.size() + 1 + word.size() > line_length)
        {
          result += line + '\n';
          line = std::string(label.size(), ' ');
        }
        line += ' ' + word;
      }
      return result + line + '\n';
    }
  } // namespace

  Warning make_warning(const std::string &name, const std::string &found, const std::vector<std::string> &values)
  {
    const auto row = page_row("warning", "", name);
    if (!row)
      throw std::logic_error("no warning '" + name + "' in params/warnings.md");
    std::string text = row->cells.at("effect") + '\n' + row->cells.at("remedy");
    if (std::count(text.begin(), text.end(), '*') != static_cast<std::ptrdiff_t>(values.size()))
      throw std::logic_error("warning '" + name + "' has another number of values in params/warnings.md");
    for (const auto &value : values)
      boost::replace_first(text, "*", value);
    const auto end = text.find('\n');
    return { name, found, text.substr(0, end), text.substr(end + 1) };
  }

  std::string to_text(const Warnings &warnings)
  {
    std::string result;
    for (const Warning &warning : warnings)
      result += '\n' + coloured("Warning: " + warning.name, STDOUT_FILENO, warning_colour) + '\n' +
                paragraph("  found: ", warning.found) + paragraph("  effect:", warning.effect) +
                paragraph("  remedy:", warning.remedy);
    return warnings.empty() ? "" : result + '\n';
  }

  std::string count_text(const Warnings &warnings)
  {
    if (warnings.empty())
      return "no warnings";
    std::string names;
    for (const Warning &warning : warnings)
      names += (names.empty() ? ": " : ", ") + warning.name;
    return std::to_string(warnings.size()) + (warnings.size() == 1 ? " warning" : " warnings") + names;
  }
} // namespace sprag
