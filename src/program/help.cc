// SPDX-License-Identifier: GPL-3.0-only
#include "program/help.h"

#include "base/errors.h"
#include "base/text.h"
#include "input/sections.h"
#include "results/page_tables.h"
#include "scene/scene.h"

#include <boost/algorithm/string/predicate.hpp>
#include <boost/algorithm/string/replace.hpp>

#include <map>
#include <vector>

namespace sprag
{
  namespace
  {
    /// Words before a name, by the kinds of tables on pages that help_text() searches.
    const std::map<std::string, std::string> &kinds_in_words()
    {
      static const std::map<std::string, std::string> words = {
        { "entry", "/summary/" }, { "column", "column " }, { "fact", "/meta/" }, { "warning", "warning " }
      };
      return words;
    }

    /// Returns a cell in words: where a line of the console summary is printed, `!` marks headlines and `?` hides 0.
    std::string cell_in_words(std::string text)
    {
      std::string marks;
      for (; !text.empty() && (text.front() == '!' || text.front() == '?'); text.erase(0, 1))
        marks += text.front() == '!' ? ", a headline" : ", not if 0";
      return text + marks;
    }

    /// Writes what the pages say of an entry, column, fact or warning; empty where they have none of this name.
    std::string result_text(const std::string &name)
    {
      std::string text;
      for (const auto &[kind, heading, row] : page_places(name))
      {
        const auto words = kinds_in_words().find(kind);
        if (words == kinds_in_words().end())
          continue;
        const auto unit = row.cells.find("unit");
        text += words->second + name + (unit == row.cells.end() || unit->second.empty() ? "" : " [" + unit->second + ']') + '\n';
        for (const auto &line : split_lines(boost::erase_all_copy(heading.substr(3), "`"), 100))
          text += "  " + line + '\n';
        for (const auto &[column, cell] : row.cells)
          if (column != "unit" && !cell.empty())
            for (const auto &line : split_lines(column + ": " + cell_in_words(cell), 100))
              text += "  " + line + '\n';
      }
      return text;
    }
  } // namespace

  std::string help_text(const std::string &name)
  {
    SceneSettings defaults;
    std::vector<Parameter> found;
    std::vector<std::string> names;
    for (const auto &parameter : scene_parameters(defaults))
    {
      for (const auto &candidate : { parameter.section, full_name(parameter) })
        if (boost::algorithm::iequals(candidate, name))
          found.push_back(parameter);
      names.insert(names.end(), { parameter.section, full_name(parameter) });
    }
    if (!found.empty())
      return parameters_text(found, { { "Time/Tolerance", number_text(defaults.scene.time.tolerance) } });
    const auto entry = name.substr(name.rfind('/') + 1);
    if (auto text = result_text(entry); !text.empty())
      return text;
    for (const auto &table : page_tables())
      if (kinds_in_words().count(table.kind) > 0)
        for (const auto &[row, cells] : table.rows)
          names.push_back(row);
    throw InputError("--help " + name + ": there is no such section, parameter, result or warning" +
                     did_you_mean(nearest(name, names)));
  }
} // namespace sprag
