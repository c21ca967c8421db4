// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "base/text.h"

#include <iosfwd>
#include <string>

namespace sprag
{
  // The printed lines of all analyses are made of these. Numbers have four digits and a unit.

  /// Pads a text with blanks on the left, with a negative width on the right.
  std::string padded(const std::string &text, int width);

  /// Returns "23.67".
  inline std::string four_digits(const double value)
  {
    return formatted("%.4g", value);
  }

  /// Returns the next number of four digits that is not less, or with `upward` = false not more.
  double rounded_to(double value, bool upward);

  /// Returns a number and its unit, "23.67 N"; the number alone where the unit is "1" or empty.
  std::string with_unit(double value, const std::string &unit);

  /// Returns the unit of a parameter, "Section/Entry"; "1" if it has none.
  std::string parameter_unit(const std::string &name);

  /// Prints a line of a label and a text.
  void summary_line(std::ostream &stream, const std::string &label, const std::string &text);

  /// Returns a relative error in per cent, with two digits.
  inline std::string percent(const double error)
  {
    return formatted("%.2g", 100. * error) + " %";
  }
} // namespace sprag
