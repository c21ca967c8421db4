// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "base/choices.h"

#include <map>
#include <string>
#include <vector>

namespace sprag
{
  /// Cells of a row by the heads of their columns: "unit", "meaning", "effect" ...
  using PageCells = std::map<std::string, std::string>;

  /// A table of a page that is built into the program. Its rows begin with a name in code.
  struct PageTable
  {
    std::string heading;     ///< of its section: "## Lever frame"
    std::string kind;        ///< head of its first column: "material", "entry", "parameter" ...
    Choices<PageCells> rows; ///< by these names
  };

  /// Returns the tables of the built-in pages, see `sprag_pages` in CMakeLists.txt.
  const std::vector<PageTable> &page_tables();

  /// Returns the first table of a kind, in the section with a heading if it is given. Throws std::out_of_range if there is none.
  const PageTable &page_table(const std::string &kind, const std::string &heading = "");
} // namespace sprag
