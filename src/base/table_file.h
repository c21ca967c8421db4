// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include <string>
#include <vector>

namespace sprag
{
  /// Holds a comment above the rows of a table that may tell the unit of a column.
  struct UnitRemark
  {
    std::string place; ///< "FILE:LINE: the comment 'TEXT'"
    std::vector<std::string> likely_units;
  };

  /// Holds a column of a table file.
  struct NamedColumn
  {
    std::string name;
    std::string unit; ///< as it was written; empty: none
    std::vector<double> values;
    std::vector<UnitRemark> remarks = {};
  };

  /// A column may be called any of these; capitals do not count. Messages name the first one.
  using ColumnNames = std::vector<std::string>;

  /// Holds the requested columns of a table file and the names of the others.
  struct NamedColumns
  {
    std::vector<NamedColumn> columns; ///< the requested ones, in their order; one that the file lacks has neither name nor values
    std::vector<std::string> names;   ///< of all columns of the file
    std::vector<std::string> unused;  ///< names of the others
  };

  // Tables are texts, or HDF5 where the file's name ends in .h5 or .hdf5. Cells of a text are separated by semicolons, tabs,
  // commas or other white space; a byte-order mark, empty lines and everything behind a # are passed over. A first line without
  // any number is a header: names with units in brackets, as in "time [s], Q [N]"; so is a comment of as many cells before the
  // rows. Another comment there that may name a unit is refused where it would change a column without unit. Of HDF5 columns are
  // datasets at the root, or in a group `table` where there is one, with at most one dimension above 1 and the unit in the
  // attribute `unit` or `units`. All functions throw InputError with one message a faulty line or column, naming the file;
  // decimal commas are told once. HDF5 prints nothing.

  /// Reads the columns of these names. A text must have a header; an empty cell is NaN.
  NamedColumns read_columns(const std::string &file, const std::vector<ColumnNames> &requested);

  /// Reads two columns of finite numbers. The names in a header may hold other words beside those asked for; without header, and
  /// under one of two columns that names neither, the first column is the first.
  NamedColumns read_two_columns(const std::string &file, const ColumnNames &first, const ColumnNames &second);

  /// Returns the values in a unit; those of a column without unit are in it already. Throws InputError naming the column.
  std::vector<double> values_in(const std::string &unit, const NamedColumn &column);

  /// Returns the factor to this unit from that of the column, 1 where it has none. Throws InputError naming the column.
  double factor_to(const std::string &unit, const NamedColumn &column);
} // namespace sprag
