#pragma once

#include <string>
#include <vector>

namespace sprag
{
  struct TwoColumns
  {
    std::string header; ///< of a text: the line before the first row, empty where there is none
    std::vector<double> first;
    std::vector<double> second;
    std::string first_unit; ///< of a dataset: its attribute "unit", empty where it has none
    std::string second_unit;
  };

  /// Reads two columns of numbers separated by a comma, a semicolon or white space. A header before the first row of numbers,
  /// empty lines and everything behind a # are passed over. Throws InputError with one message a faulty line, each naming file
  /// and line, but one alone for decimal commas; an unreadable file or one without numbers is an error too.
  TwoColumns read_two_columns(const std::string &file);

  /// Returns whether a header names the columns in the other order: the first by a word for the second alone, and the other way
  /// round. The words are in lower case.
  bool exchanged_columns(const std::string &header, const std::vector<std::string> &first,
                         const std::vector<std::string> &second);

  struct ColumnNames
  {
    std::string first;
    std::string second;
  };

  /// Reads two columns of numbers: from the datasets of these names, one-dimensional and at the root, where the file's name ends
  /// in .h5 or .hdf5, otherwise from a text, see read_two_columns(). Throws InputError naming the file. HDF5 prints nothing.
  TwoColumns read_table(const std::string &file, const ColumnNames &names);
} // namespace sprag
