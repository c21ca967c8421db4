// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "base/pages.h"
#include "results/columns.h"

#include <optional>
#include <string>
#include <vector>

namespace sprag
{
  /// A row of a table on a page that is built into the program, which takes names, units and meanings from there.
  struct PageRow
  {
    PageCells cells;
    std::string word; ///< in place of `*` in the row's name and cells; empty without one
  };

  /// Finds the row for a name among tables of one `kind`, "entry", "column", "fact" or "warning", as the heading of their first
  /// column says: in sections whose heading has `type` in code or, where none of these fits, in sections without code. Of several
  /// rows it is the one whose `*` stands for least.
  std::optional<PageRow> page_row(const std::string &kind, const std::string &type, const std::string &name);

  /// A row together with the kind of its table and the heading of its section.
  struct PagePlace
  {
    std::string kind, heading;
    PageRow row;
  };

  /// Returns the rows for a name in all tables, at most one of each.
  std::vector<PagePlace> page_places(const std::string &name);

  /// Returns the column of one name. Throws std::out_of_range where the pages have none.
  ColumnInfo page_column(const std::string &type, const std::string &name);

  /// Returns the columns with these names, separated by blanks. Throws std::out_of_range where the pages have none.
  std::vector<ColumnInfo> page_columns(const std::string &type, const std::string &names);
} // namespace sprag
