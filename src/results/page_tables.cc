// SPDX-License-Identifier: GPL-3.0-only
#include "results/page_tables.h"

#include "base/pages.h"

#include <boost/algorithm/string/predicate.hpp>
#include <boost/algorithm/string/replace.hpp>

#include <sstream>
#include <stdexcept>

namespace sprag
{
  namespace
  {
    /// Returns the part of the name at `*`, and none where the pattern does not fit.
    std::optional<std::string> word_in(const std::string &name, const std::string &pattern)
    {
      const auto star = pattern.find('*');
      if (star == std::string::npos)
        return {};
      const auto before = pattern.substr(0, star), after = pattern.substr(star + 1);
      if (name.size() <= before.size() + after.size() || !boost::starts_with(name, before) || !boost::ends_with(name, after))
        return {};
      return boost::replace_all_copy(name.substr(star, name.size() - before.size() - after.size()), "_", " ");
    }

    /// Finds the row of a table for a name: the one of this name or, without one, the one whose `*` stands for least.
    std::optional<PageRow> find_row(const PageTable &table, const std::string &name)
    {
      std::optional<PageRow> result;
      for (const auto &[row, cells] : table.rows)
      {
        if (row == name)
          return PageRow{ cells, {} };
        if (const auto word = word_in(name, row); word && (!result || word->size() < result->word.size()))
          result = { cells, *word };
      }
      return result;
    }

    /// Puts the word in place of each `*` of the cells.
    std::optional<PageRow> completed(std::optional<PageRow> row)
    {
      if (row && !row->word.empty())
        for (auto &[column, cell] : row->cells)
          boost::replace_all(cell, "*", row->word);
      return row;
    }

    /// Finds the row among the tables of a kind in sections whose heading holds `code`; empty: in those without any code.
    std::optional<PageRow> find_row(const std::string &name, const std::string &kind, const std::string &code)
    {
      std::optional<PageRow> result;
      for (const auto &table : page_tables())
        if (table.kind == kind && boost::contains(table.heading, code.empty() ? "`" : code) != code.empty())
          if (const auto row = find_row(table, name); row && (!result || row->word.size() < result->word.size()))
            result = row;
      return completed(result);
    }
  } // namespace

  std::optional<PageRow> page_row(const std::string &kind, const std::string &type, const std::string &name)
  {
    const auto row = find_row(name, kind, '`' + type + '`');
    return row ? row : find_row(name, kind, "");
  }

  std::vector<PagePlace> page_places(const std::string &name)
  {
    std::vector<PagePlace> places;
    for (const auto &table : page_tables())
      if (const auto row = completed(find_row(table, name)))
        places.push_back({ table.kind, table.heading, *row });
    return places;
  }

  ColumnInfo page_column(const std::string &type, const std::string &name)
  {
    const auto row = page_row("column", type, name);
    if (!row)
      throw std::out_of_range("no column '" + name + "' on the pages");
    return { name, row->cells.at("unit"), row->cells.at("meaning") };
  }

  std::vector<ColumnInfo> page_columns(const std::string &type, const std::string &names)
  {
    std::vector<ColumnInfo> columns;
    std::istringstream words(names);
    for (std::string name; words >> name;)
      columns.push_back(page_column(type, name));
    return columns;
  }
} // namespace sprag
