#pragma once

#include "base/csv.h"

#include <string>

namespace sprag
{
  struct ColumnNames
  {
    std::string first;
    std::string second;
  };

  /// Reads two columns of numbers: from the datasets of these names, one-dimensional and at the root, where the file's name ends
  /// in .h5 or .hdf5, otherwise from a text, see read_two_columns(). Throws InputError naming the file. HDF5 prints nothing.
  TwoColumns read_table(const std::string &file, const ColumnNames &names);
} // namespace sprag
