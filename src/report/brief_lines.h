// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "analytic/error_estimate.h"
#include "results/result_file.h"

#include <iosfwd>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace sprag
{
  // What the printed lines of all analyses are made of. Numbers have four digits and a unit.

  /// Entries by name, those that are known: texts, and numbers that are not NaN. The entries must outlive it.
  class Known
  {
  public:
    explicit Known(const std::vector<Entry> &entries);

    /// Returns the number of this name, none if it is unknown.
    std::optional<double> number(const std::string &name) const;

    /// Returns the text of this name, an empty one if it is unknown.
    std::string text(const std::string &name) const;

    /// Returns the number of this name with its unit, "23.67 N"; "-" if it is unknown.
    std::string quantity(const std::string &name) const;

    /// Returns a relative number of this name in per cent, without its sign, "0.076 %"; "-" if it is unknown.
    std::string share(const std::string &name) const;

  private:
    std::map<std::string, const Entry *> known;
  };

  /// Pads a text with blanks on the left, with a negative width on the right.
  std::string padded(const std::string &text, int width);

  /// Returns "23.67", and "-" without a value.
  std::string four_digits(const std::optional<double> &value);

  /// Returns a number and its unit, "23.67 N"; the number alone where the unit is "1" or empty.
  std::string with_unit(double value, const std::string &unit);

  /// Returns the unit of a parameter, "Section/Entry"; "" if it has none.
  std::string unit_of_parameter(const std::string &name);

  /// Prints a line of a label and a text.
  void brief_line(std::ostream &stream, const std::string &label, const std::string &text);

  /// Prints the estimated errors, what has none, and what would lessen the largest; nothing without estimates.
  void print_brief_errors(std::ostream &stream, const std::vector<ErrorEstimate> &errors);

  /// Prints the line of the CPU time, and of the steps where there are any.
  void print_brief_cost(std::ostream &stream, const Known &known, double cpu_seconds);
} // namespace sprag
