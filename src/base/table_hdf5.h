// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "base/table_file.h"

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace sprag
{
  /// Far beyond any measurement, and short enough for memory.
  constexpr std::size_t most_table_rows = 10000000;

  /// Indices of the requested columns; none for one that the file lacks.
  using ChosenColumns = std::vector<std::optional<std::size_t>>;
  using ChooseColumns = std::function<ChosenColumns(const std::vector<NamedColumn> &header)>;

  /// Holds the columns of a table file, or what is wrong with it.
  struct TableContent
  {
    std::vector<NamedColumn> columns;
    ChosenColumns chosen;
    std::vector<std::string> mistakes;
  };

  /// Reads a table in HDF5 in a process without rights, as the file may crash the library or name other files.
  TableContent read_hdf5_table(const std::string &path, const ChooseColumns &choose);
} // namespace sprag
