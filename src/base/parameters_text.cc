// SPDX-License-Identifier: GPL-3.0-only
#include "base/parameters.h"

#include "base/escaped.h"

#include <algorithm>
#include <iomanip>
#include <sstream>

namespace sprag
{
  namespace
  {
    constexpr std::size_t comment_width = 74;

    /// Breaks a text between words, where there is room for them.
    std::vector<std::string> split_lines(const std::string &text)
    {
      std::vector<std::string> lines;
      std::istringstream words(text);
      for (std::string word; words >> word;)
        if (!lines.empty() && lines.back().size() + 1 + word.size() <= comment_width)
          lines.back() += " " + word;
        else
          lines.push_back(word);
      return lines;
    }

    /// An entry as it is printed.
    struct Entry
    {
      const Parameter &parameter;
      std::string value;
      std::string written; ///< with a unit; empty where it had none
    };

    template <class Length>
    int longest(const std::vector<Entry> &entries, const Length &length)
    {
      std::size_t result = 0;
      for (const auto &entry : entries)
        result = std::max(result, length(entry));
      return static_cast<int>(result);
    }

    void print(std::ostream &text, const std::string &section, const std::vector<Entry> &entries)
    {
      const int name  = longest(entries, [](const Entry &entry) { return entry.parameter.name.size(); });
      const int value = longest(entries, [](const Entry &entry) { return entry.value.size(); });
      text << "subsection " << section << '\n' << std::left;
      for (const auto &entry : entries)
      {
        const Parameter &parameter = entry.parameter;
        if (&entry != &entries.front())
          text << '\n';
        for (const auto &line : split_lines(documentation(parameter)))
          text << "  # " << line << '\n';
        text << "  set " << std::setw(name) << parameter.name << " = ";
        const std::string by_default = escaped(parameter.default_value);
        const std::string written    = entry.written.empty() ? "" : "given as " + escaped(entry.written);
        const std::string usual      = entry.value == by_default ? "" : "default: " + by_default;
        if (written.empty() && usual.empty())
          text << entry.value << '\n';
        else
          text << std::setw(value) << entry.value << " # " << written << (written.empty() || usual.empty() ? "" : "; ") << usual
               << '\n';
      }
      text << "end\n\n\n";
    }
  } // namespace

  std::string parameters_text(const std::vector<Parameter> &declared, const ParameterValues &specified,
                              const ParameterValues &written)
  {
    std::vector<std::string> sections;
    std::map<std::string, std::vector<Entry>> entries;
    for (const auto &parameter : declared)
    {
      const auto value = specified.find(full_name(parameter));
      const auto text  = written.find(full_name(parameter));
      if (entries.count(parameter.section) == 0)
        sections.push_back(parameter.section);
      entries[parameter.section].push_back({ parameter,
                                             escaped(value == specified.end() ? parameter.default_value : value->second),
                                             text == written.end() ? "" : text->second });
    }
    std::ostringstream text;
    text << "# Listing of Parameters\n# ---------------------\n";
    for (const auto &section : sections)
      print(text, section, entries.at(section));
    return text.str();
  }
} // namespace sprag
