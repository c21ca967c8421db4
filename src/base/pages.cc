// SPDX-License-Identifier: GPL-3.0-only
#include "base/pages.h"

#include "base/text.h"

#include <boost/algorithm/string/predicate.hpp>

#include <algorithm>
#include <sstream>
#include <stdexcept>

namespace sprag
{
  extern const char *const page_texts; // put in by CMake

  namespace
  {
    std::vector<PageTable> read_page_tables()
    {
      std::vector<PageTable> tables;
      std::vector<std::string> heads;
      std::istringstream lines(page_texts);
      std::string heading;
      for (std::string line; std::getline(lines, line);)
      {
        if (boost::starts_with(line, "## "))
          heading = line;
        if (!boost::starts_with(line, "| "))
          continue;
        auto cells = split(line, '|');
        if (!boost::starts_with(cells[1], "`"))
        {
          heads = cells;
          tables.push_back({ heading, cells[1], {} });
          continue;
        }
        for (auto &cell : cells)
          cell.erase(std::remove(cell.begin(), cell.end(), '`'), cell.end());
        auto &row = tables.back().rows.emplace_back(cells[1], PageCells()).second;
        for (std::size_t i = 2; i < std::min(cells.size(), heads.size()); ++i)
          row[heads[i]] = cells[i];
      }
      return tables;
    }
  } // namespace

  const std::vector<PageTable> &page_tables()
  {
    static const auto tables = read_page_tables();
    return tables;
  }

  const PageTable &page_table(const std::string &kind, const std::string &heading)
  {
    for (const auto &table : page_tables())
      if (table.kind == kind && (heading.empty() || table.heading == heading))
        return table;
    throw std::out_of_range("no table of a " + kind + " on the pages");
  }
} // namespace sprag
