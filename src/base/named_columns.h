#pragma once

#include <string>
#include <vector>

namespace sprag
{
  struct NamedColumn
  {
    std::string name;
    std::string unit; ///< as it was written; empty: none
    std::vector<double> values;
  };

  /// Reads the columns that have one of these names, equally long. Of a text their names and units stand in its first line, as in
  /// "time [s], Q [N]", separated by commas, semicolons or tabs as the rows are; empty lines and everything behind a # are passed
  /// over, and an empty cell is NaN. Of a file that ends in .h5 or .hdf5 they are datasets of one dimension at the root, or in a
  /// group `table` where there is one, with units in the attribute `unit` or `units`. `found` gets the names of all columns there
  /// are. Throws InputError with one message a faulty line.
  std::vector<NamedColumn> read_named_columns(const std::string &file, const std::vector<std::string> &names,
                                              std::vector<std::string> &found);
} // namespace sprag
