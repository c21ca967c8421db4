// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace sprag
{
  /// Numbers between two bounds.
  struct Interval
  {
    double low    = -std::numeric_limits<double>::infinity();
    double high   = std::numeric_limits<double>::infinity();
    bool has_low  = true; ///< whether `low` itself belongs to it
    bool has_high = true;
  };

  Interval any_number();
  Interval above(double low);
  Interval at_least(double low);
  /// Returns an interval to which neither bound belongs.
  Interval between(double low, double high);

  /// A rule that the text of a parameter's value must keep.
  struct Rule
  {
    enum class Kind
    {
      number,
      integer,
      number_or_auto,
      numbers, ///< separated by commas, at least one
      choice,
      text, ///< anything
      file  ///< the path of one that is read, or nothing
    };

    Kind kind = Kind::text;
    Interval interval;                ///< number kinds
    std::string unit;                 ///< number kinds; empty: dimensionless
    std::vector<std::string> choices; ///< choice
  };

  /// Returns whether the unit depends on other parameters, as in "N/mm^n" or "of First parameter". A value keeps the unit behind
  /// it until these are known.
  bool depends_on_others(const Rule &rule);

  /// Tells the rule in words, without the unit: "a number > 0", "one of a | b".
  std::string description(const Rule &rule);

  /// Returns none where `value` keeps the rule. Otherwise it says what the value must be. Numbers stand without unit.
  std::optional<std::string> violation(const Rule &rule, const std::string &value);

  /// Returns a value that keeps the rule, its numbers in the rule's unit and without it, as "210000" for "210 GPa"; rounded to 15
  /// digits where they were in another. A number whose unit depends on others may still break it. Throws InputError with what the
  /// value must be.
  std::string kept_value(const Rule &rule, const std::string &value);

  /// Reads the numbers of a comma-separated list that keeps its rule.
  std::vector<double> list_of_numbers(const std::string &value);
} // namespace sprag
