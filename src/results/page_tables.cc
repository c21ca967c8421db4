// SPDX-License-Identifier: GPL-3.0-only
#include "results/page_tables.h"

#include "base/text.h"

#include <boost/algorithm/string/erase.hpp>
#include <boost/algorithm/string/predicate.hpp>
#include <boost/algorithm/string/replace.hpp>

#include <algorithm>
#include <map>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace sprag
{
  extern const char *const result_pages; // put in by CMake

  namespace
  {
    struct PageTable
    {
      std::string heading;
      std::vector<std::string> columns;                      ///< their heads from the names on
      std::map<std::string, PageRow> rows;                   ///< by name
      std::vector<std::pair<std::string, PageRow>> patterns; ///< rows with `*` in their names
    };

    std::vector<PageTable> read_tables()
    {
      std::vector<PageTable> tables;
      std::istringstream lines(result_pages);
      std::string heading;
      for (std::string line; std::getline(lines, line);)
      {
        if (boost::starts_with(line, "## "))
          heading = line;
        auto cells = split(line, '|');
        if (cells.size() < 4 || boost::starts_with(cells[1], "-"))
          continue;
        if (!boost::starts_with(cells[1], "`"))
        {
          tables.push_back({ heading, { cells.begin() + 1, cells.end() }, {}, {} });
          continue;
        }
        for (auto &cell : cells)
          boost::erase_all(cell, "`");
        auto &table = tables.back();
        PageRow row;
        for (std::size_t i = 1; i < std::min(cells.size() - 1, table.columns.size()); ++i)
          row.cells[table.columns[i]] = cells[i + 1];
        if (boost::contains(cells[1], "*"))
          table.patterns.emplace_back(cells[1], row);
        else
          table.rows.emplace(cells[1], row);
      }
      return tables;
    }

    const std::vector<PageTable> &page_tables()
    {
      static const auto tables = read_tables();
      return tables;
    }

    /// Returns what `*` stands for, and none where the pattern does not fit the name.
    std::optional<std::string> word_in(const std::string &name, const std::string &pattern)
    {
      const auto star   = pattern.find('*');
      const auto before = pattern.substr(0, star), after = pattern.substr(star + 1);
      if (name.size() <= before.size() + after.size() || !boost::starts_with(name, before) || !boost::ends_with(name, after))
        return {};
      return boost::replace_all_copy(name.substr(star, name.size() - before.size() - after.size()), "_", " ");
    }

    /// Finds the row among the tables that `serves` admits.
    template <class Serves>
    std::optional<PageRow> find_row(const std::string &name, const Serves &serves)
    {
      std::optional<PageRow> result;
      for (const auto &table : page_tables())
      {
        if (!serves(table))
          continue;
        if (const auto found = table.rows.find(name); found != table.rows.end())
          return found->second;
        for (const auto &[pattern, row] : table.patterns)
          if (const auto word = word_in(name, pattern); word && (!result || word->size() < result->word.size()))
          {
            result       = row;
            result->word = *word;
          }
      }
      if (result)
        for (auto &[column, cell] : result->cells)
          boost::replace_all(cell, "*", result->word);
      return result;
    }
  } // namespace

  std::optional<PageRow> page_row(const std::string &kind, const std::string &type, const std::string &name)
  {
    const auto code = '`' + type + '`';
    if (auto row =
            find_row(name, [&](const PageTable &one) { return one.columns[0] == kind && boost::contains(one.heading, code); }))
      return row;
    return find_row(name, [&](const PageTable &one) { return one.columns[0] == kind && !boost::contains(one.heading, "`"); });
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
