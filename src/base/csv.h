#pragma once

#include <string>
#include <vector>

namespace sprag
{
  struct TwoColumns
  {
    std::vector<double> first;
    std::vector<double> second;
  };

  /// Reads two columns of numbers separated by a comma, a semicolon or white space. A header before the first row of numbers,
  /// empty lines and everything behind a # are passed over. Throws InputError with one message a faulty line, each naming file
  /// and line; an unreadable file or one without numbers is an error too.
  TwoColumns read_two_columns(const std::string &file);
} // namespace sprag
