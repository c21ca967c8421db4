// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <set>
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

  inline Interval any_number()
  {
    return {};
  }

  inline Interval above(const double low)
  {
    return { low, std::numeric_limits<double>::infinity(), false, true };
  }

  inline Interval at_least(const double low)
  {
    return { low, std::numeric_limits<double>::infinity(), true, true };
  }

  /// Returns an interval to which neither bound belongs.
  inline Interval between(const double low, const double high)
  {
    return { low, high, false, false };
  }

  /// A rule that the text of a parameter's value must keep.
  struct Rule
  {
    /// Says which values are valid.
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

  /// Returns whether a value is one number, or auto.
  inline bool is_number(const Rule &rule)
  {
    return rule.kind == Rule::Kind::number || rule.kind == Rule::Kind::integer || rule.kind == Rule::Kind::number_or_auto;
  }

  /// Returns whether the unit depends on other parameters, as in "N/mm^n" or "of First parameter". A value keeps the unit behind
  /// it until these are known.
  bool depends_on_others(const Rule &rule);

  /// Returns the rule in words, without the unit: "a number > 0", "one of a | b".
  std::string description(const Rule &rule);

  /// Returns none where `value` keeps the rule. Otherwise it says what the value must be. Numbers stand without unit.
  std::optional<std::string> violation(const Rule &rule, const std::string &value);

  /// Returns a value that keeps the rule, its numbers in the rule's unit and without it, as "210000" for "210 GPa"; rounded to 15
  /// digits where they were in another. A number whose unit depends on others may still break it. Throws InputError with what the
  /// value must be.
  std::string kept_value(const Rule &rule, const std::string &value);

  /// Returns the numbers of a group, those without unit with that of the last. Other texts stay. Throws InputError where the unit
  /// that is meant is not clear: where an earlier number has another one, or the last one none. Without dimension, where a number
  /// alone is complete, each or none must have a unit.
  std::vector<std::string> with_common_unit(const Rule &rule, const std::vector<std::string> &numbers);

  /// Reads the numbers of a comma-separated list that keeps its rule.
  std::vector<double> parse_numbers(const std::string &value);

  // Parameter files as dealii::ParameterHandler knows them, except that every mistake in them is found, not only the first, and
  // that no library is loaded for them.

  /// A declared entry of a parameter file. Names hold neither '/' nor '='.
  struct Parameter
  {
    std::string section;
    std::string name;
    std::string default_value;
    Rule rule;
    std::string meaning;                            ///< with the symbol it has in the paper
    std::function<void(const std::string &)> store; ///< takes a value that keeps the rule
    std::string choice = {}; ///< full name of the choice that it counts with alone; empty: it always counts
    std::string chosen = {}; ///< value of that choice with which it counts
  };

  /// Returns "Section/Name".
  inline std::string full_name(const Parameter &parameter)
  {
    return parameter.section + "/" + parameter.name;
  }

  /// Returns the parameter with this full name, null where none is declared.
  const Parameter *find_parameter(const std::vector<Parameter> &declared, const std::string &name);

  /// Returns meaning, unit and range in words.
  std::string documentation(const Parameter &parameter);

  /// A value given by the user and where: "FILE:LINE" or "--set".
  struct Setting
  {
    std::string place;
    std::string value;        ///< numbers in the parameter's own unit, without it
    std::string written = {}; ///< where it was given with a unit: as it was written
  };

  /// Everything that a parameter file and the overrides give, mistakes included.
  struct Settings
  {
    std::string file;                         ///< as given by the user
    std::map<std::string, Setting> specified; ///< by full name; only declared parameters and values that keep their rule
    std::set<std::string> invalid;            ///< full names whose value is unknown because of a mistake
    std::vector<std::string> mistakes;        ///< a line each: "PLACE: Section/Name = value: RULE"
  };

  /// Reads the file, then the overrides "Section/Name=value", the later of two with the same name counting. Throws nothing: an
  /// unreadable file is a mistake too.
  Settings read_settings(const std::string &file, const std::vector<std::string> &overrides,
                         const std::vector<Parameter> &declared);

  /// Values by full name.
  using ParameterValues = std::map<std::string, std::string>;

  /// Reads the overrides on top of values that were read before and keep their rules. Messages call these values those of `file`.
  Settings override_settings(const std::string &file, const ParameterValues &values, const std::vector<std::string> &overrides,
                             const std::vector<Parameter> &declared);

  /// Adds the mistake that the parameter with this full name breaks `rule`, with its place and the value in use.
  void add_mistake(Settings &settings, const std::vector<Parameter> &declared, const std::string &name, const std::string &rule);

  /// Writes every parameter with its documentation as a comment, in .prm form: the given values, defaults elsewhere. What was
  /// written with a unit is a comment behind its value, and the line of a parameter in `open` is one as a whole, "#set NAME =
  /// ...". The text can be read back.
  std::string parameters_text(const std::vector<Parameter> &declared, const ParameterValues &specified,
                              const ParameterValues &written = {}, const std::set<std::string> &open = {});
} // namespace sprag
