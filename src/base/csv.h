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
  };

  /// Reads two columns of numbers separated by a comma, a semicolon or white space. A header before the first row of numbers,
  /// empty lines and everything behind a # are passed over. Throws InputError with one message a faulty line, each naming file
  /// and line, but one alone for decimal commas; an unreadable file or one without numbers is an error too.
  TwoColumns read_two_columns(const std::string &file);

  /// Returns whether a header names the columns in the other order: the first by a word for the second alone, and the other way
  /// round. The words are in lower case.
  bool exchanged_columns(const std::string &header, const std::vector<std::string> &first,
                         const std::vector<std::string> &second);
} // namespace sprag
