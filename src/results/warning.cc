// SPDX-License-Identifier: GPL-3.0-only
#include "results/warning.h"

#include "base/pages.h"
#include "base/ranges.h"
#include "base/system/terminal.h"
#include "base/text.h"

#include <boost/algorithm/string/join.hpp>
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
      const auto lines = split_lines(text, line_length - label.size() - 1);
      return label + ' ' + boost::algorithm::join(lines, '\n' + std::string(label.size() + 1, ' ')) + '\n';
    }
  } // namespace

  Warning make_warning(const std::string &name, const std::vector<std::string> &values)
  {
    const auto &cells = value_for(page_table("warning").rows, name);
    std::size_t next  = 0;
    const auto filled = [&](const std::string &column)
    {
      std::string text;
      for (const char c : cells.at(column))
        text += c == '*' ? values.at(next++) : std::string(1, c);
      return text;
    };
    const Warning result{ name, filled("found"), filled("effect"), filled("remedy") };
    if (next != values.size())
      throw std::logic_error("warning '" + name + "' has fewer values in params/warnings.md");
    return result;
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
    return std::to_string(warnings.size()) + (warnings.size() == 1 ? " warning: " : " warnings: ") +
           boost::algorithm::join(mapped(warnings, &Warning::name), ", ");
  }
} // namespace sprag
