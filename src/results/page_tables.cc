// SPDX-License-Identifier: GPL-3.0-only
#include "results/page_tables.h"

#include "base/text.h"

#include <boost/algorithm/string/erase.hpp>
#include <boost/algorithm/string/predicate.hpp>
#include <boost/algorithm/string/replace.hpp>

#include <sstream>
#include <stdexcept>

namespace sprag
{
  extern const char *const result_pages; // put in by CMake

  namespace
  {
    struct TableRow
    {
      std::string heading, kind, name;
      PageRow cells;
    };

    std::vector<TableRow> rows_of_pages()
    {
      std::vector<TableRow> rows;
      std::istringstream lines(result_pages);
      std::string heading, kind;
      for (std::string line; std::getline(lines, line);)
      {
        if (boost::starts_with(line, "## "))
          heading = line;
        auto cells = split(line, '|');
        if (cells.size() < 4)
          continue;
        if (!boost::starts_with(cells[1], "`"))
          kind = boost::starts_with(cells[1], "-") ? kind : cells[1];
        else
        {
          for (auto &cell : cells)
            boost::erase_all(cell, "`");
          rows.push_back({ heading, kind, cells[1], { cells[2], cells.size() > 4 ? cells[3] : "", cells.back(), {} } });
        }
      }
      return rows;
    }

    /// Returns what `*` stands for, and none where the pattern does not fit the name.
    std::optional<std::string> word_in(const std::string &name, const std::string &pattern)
    {
      const auto star = pattern.find('*');
      if (star == std::string::npos)
        return name == pattern ? std::make_optional<std::string>() : std::nullopt;
      const auto before = pattern.substr(0, star), after = pattern.substr(star + 1);
      if (name.size() <= before.size() + after.size() || !boost::starts_with(name, before) || !boost::ends_with(name, after))
        return {};
      return boost::replace_all_copy(name.substr(star, name.size() - before.size() - after.size()), "_", " ");
    }
  } // namespace

  std::optional<PageRow> page_row(const std::string &kind, const std::string &type, const std::string &name)
  {
    static const auto rows = rows_of_pages();
    std::optional<PageRow> result;
    for (const bool is_of_type : { true, false })
    {
      for (const auto &row : rows)
        if (row.kind == kind && boost::contains(row.heading, is_of_type ? '`' + type + '`' : "`") == is_of_type)
          if (const auto word = word_in(name, row.name); word && (!result || word->size() < result->word.size()))
          {
            result       = row.cells;
            result->word = *word;
          }
      if (result)
        break;
    }
    if (result)
      for (auto *const cell : { &result->printed, &result->meaning })
        boost::replace_all(*cell, "*", result->word);
    return result;
  }

  std::vector<ColumnInfo> columns_of_pages(const std::string &type, const std::string &names)
  {
    std::vector<ColumnInfo> columns;
    std::istringstream words(names);
    for (std::string name; words >> name;)
    {
      const auto row = page_row("column", type, name);
      if (!row)
        throw std::out_of_range("no column '" + name + "' on the pages");
      columns.push_back({ name, row->unit, row->meaning });
    }
    return columns;
  }
} // namespace sprag
