// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include <cstdio>
#include <optional>
#include <string>
#include <vector>

namespace sprag
{
  /// Returns the text without white space at its ends.
  std::string trim(const std::string &text);

  /// Returns the parts between the delimiters, without blanks at their ends. Behind a delimiter at the end there is no part.
  std::vector<std::string> split(const std::string &text, char delimiter);

  /// Returns all parts between the delimiters, empty ones included, without white space at their ends.
  std::vector<std::string> split_all(const std::string &text, char delimiter);

  /// Returns the text with single blanks between its words and none at its ends.
  std::string single_spaced(const std::string &text);

  /// Writes values as std::printf() does, in at most 63 characters.
  template <class... Values>
  std::string formatted(const char *format, const Values... values)
  {
    char text[64];
    std::snprintf(text, sizeof(text), format, values...);
    return text;
  }

  /// Writes a number in the shortest decimal form that reads back as the same number.
  std::string number_text(double value);

  /// Writes a number with at most six significant digits, for a reader's eye.
  inline std::string rounded_text(const double value)
  {
    return formatted("%.6g", value);
  }

  /// Writes a length as "12.5 mm", rounded.
  inline std::string mm(const double length)
  {
    return rounded_text(length) + " mm";
  }

  /// Returns "row 1: " for index 0, the beginning of a message about a row of a table.
  inline std::string row_label(const std::size_t index)
  {
    return "row " + std::to_string(index + 1) + ": ";
  }

  /// A number at the beginning of a text, and the rest.
  struct LeadingNumber
  {
    double value;
    std::string rest; ///< without white space at its ends; empty where the text is a number alone
  };

  /// Reads the number that a text begins with; returns none where it does not begin with a finite decimal number.
  std::optional<LeadingNumber> leading_number(const std::string &text);

  /// Reads a text that is a finite decimal number and nothing else; returns none for another.
  std::optional<double> number_alone(const std::string &text);

  /// Returns whether a number in the text may have a separator of thousands, as 74,000 or 1.234,5 but not 0,123.
  bool may_separate_thousands(const std::string &text);

  /// Returns how a number with a comma must be written, as "with a decimal point: did you mean '5.6 mm'?"; none where a text does
  /// not begin with one. A value that may be meant otherwise is not proposed.
  std::optional<std::string> comma_rule(const std::string &text);

  /// Returns how a list must be written whose commas may be decimal, as they stand between two digits; none where none does.
  std::optional<std::string> list_comma_rule(const std::string &text);

  /// Returns the candidate with the smallest edit distance (Levenshtein, capitals ignored), 1 where it begins with the name, of
  /// four characters at least; none where even that would change more than half of the name.
  std::optional<std::string> nearest(const std::string &name, const std::vector<std::string> &candidates);

  /// Returns "; did you mean 'X'?", or an empty text without a candidate.
  inline std::string did_you_mean(const std::optional<std::string> &candidate)
  {
    return candidate ? "; did you mean '" + *candidate + "'?" : "";
  }

  /// Breaks a text between words into lines of at most `width` characters; a longer word has a line of its own.
  std::vector<std::string> split_lines(const std::string &text, std::size_t width);

  /// Returns a name as an identifier: in small letters, with underscores for all that is neither letter nor digit.
  std::string to_identifier(const std::string &name);

  /// Returns the text with each control character as \xHH, its hexadecimal number.
  std::string printable(const std::string &text);

  /// Returns the text so that it is a value in a parameter file: printable, and with all that would be taken for a comment, a
  /// continued line, an escape or white space at an end as \xHH.
  std::string escaped(const std::string &text);

  /// Returns what a value of a parameter file means: the inverse of escaped().
  std::string unescaped(const std::string &text);
} // namespace sprag
