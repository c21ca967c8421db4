// SPDX-License-Identifier: GPL-3.0-only
#include "base/rule.h"

#include "base/errors.h"
#include "base/text.h"
#include "base/units.h"

#include <boost/algorithm/string/join.hpp>
#include <boost/algorithm/string/predicate.hpp>

#include <algorithm>
#include <cctype>
#include <cmath>

namespace sprag
{
  namespace
  {
    constexpr double infinity = std::numeric_limits<double>::infinity();

    bool contains(const Interval &interval, const double value)
    {
      return (interval.has_low ? value >= interval.low : value > interval.low) &&
             (interval.has_high ? value <= interval.high : value < interval.high);
    }

    std::string description(const Interval &interval)
    {
      std::string text;
      if (interval.low > -infinity)
        text += (interval.has_low ? " >= " : " > ") + number_text(interval.low);
      if (interval.high < infinity)
        text += (text.empty() ? "" : " and") + std::string(interval.has_high ? " <= " : " < ") + number_text(interval.high);
      return text;
    }

    std::string in_brackets(const std::string &unit)
    {
      return unit.empty() ? "" : " [" + unit + "]";
    }

    std::optional<std::string> number_violation(const Rule &rule, const std::string &value)
    {
      const auto number = leading_number(value);
      if (const auto meant = with_decimal_point(value); meant && rule.kind != Rule::Kind::integer)
        return "must be " + description(rule) + " with a decimal point: did you mean '" + *meant + "'?";
      if (number && !number->rest.empty())
        return "must be " + description(rule) + " and nothing else";
      const bool whole = rule.kind != Rule::Kind::integer || (number && number->value == std::floor(number->value));
      if (!number || !whole || !contains(rule.interval, number->value))
        return "must be " + description(rule) + in_brackets(rule.unit);
      return std::nullopt;
    }

    bool begins_as_unit(const std::string &text)
    {
      const unsigned char first = text.empty() ? '\0' : text.front();
      return std::isalpha(first) != 0 || first == '%' || first == '(' || first > 127 || boost::starts_with(text, "1/");
    }

    /// The number in the rule's unit; other texts as they are.
    std::string without_unit(const Rule &rule, const std::string &value)
    {
      const auto number = leading_number(value);
      if (!number || !begins_as_unit(number->rest) || with_decimal_point(value))
        return value;
      if (number->rest == rule.unit)
        return number_text(number->value);
      try
      {
        const double converted = number->value * unit_factor(number->rest, rule.unit);
        if (!std::isfinite(converted))
          throw InputError("is too large");
        return number_text(leading_number(formatted("%.15g", converted))->value);
      }
      catch (const InputError &error)
      {
        throw InputError("must be " + description(rule) + in_brackets(rule.unit) + ": " + error.what());
      }
    }

    std::optional<std::string> list_violation(const Rule &rule, const std::string &value)
    {
      const auto parts = split(value, ',');
      Rule each        = rule;
      each.kind        = Rule::Kind::number;
      const bool kept  = std::all_of(parts.begin(), parts.end(), [&](const auto &part) { return !number_violation(each, part); });
      return kept && !parts.empty() ? std::nullopt : std::make_optional("must be " + description(rule));
    }

    std::optional<std::string> choice_violation(const Rule &rule, const std::string &value)
    {
      if (std::find(rule.choices.begin(), rule.choices.end(), value) != rule.choices.end())
        return std::nullopt;
      return "must be " + description(rule) + did_you_mean(nearest(value, rule.choices));
    }
  } // namespace

  bool depends_on_others(const Rule &rule)
  {
    return boost::starts_with(rule.unit, "of ") || boost::ends_with(rule.unit, "^n");
  }

  Interval any_number()
  {
    return {};
  }

  Interval above(const double low)
  {
    return { low, infinity, false, true };
  }

  Interval at_least(const double low)
  {
    return { low, infinity, true, true };
  }

  Interval between(const double low, const double high)
  {
    return { low, high, false, false };
  }

  std::string description(const Rule &rule)
  {
    switch (rule.kind)
    {
    case Rule::Kind::number:
      return "a number" + description(rule.interval);
    case Rule::Kind::integer:
      return "an integer" + description(rule.interval);
    case Rule::Kind::number_or_auto:
      return "auto or a number" + description(rule.interval);
    case Rule::Kind::numbers:
      return "numbers" + description(rule.interval) + ", separated by commas";
    case Rule::Kind::choice:
      return "one of " + boost::algorithm::join(rule.choices, " | ");
    case Rule::Kind::file:
      return "a file";
    case Rule::Kind::text:
      break;
    }
    return "a text";
  }

  std::optional<std::string> violation(const Rule &rule, const std::string &value)
  {
    switch (rule.kind)
    {
    case Rule::Kind::number_or_auto:
      return value == "auto" ? std::nullopt : number_violation(rule, value);
    case Rule::Kind::number:
    case Rule::Kind::integer:
      return number_violation(rule, value);
    case Rule::Kind::numbers:
      return list_violation(rule, value);
    case Rule::Kind::choice:
      return choice_violation(rule, value);
    case Rule::Kind::text:
    case Rule::Kind::file:
      break;
    }
    return std::nullopt;
  }

  std::string kept_value(const Rule &rule, const std::string &value)
  {
    const bool is_number =
        rule.kind == Rule::Kind::number || rule.kind == Rule::Kind::integer || rule.kind == Rule::Kind::number_or_auto;
    const auto number = leading_number(value);
    if (is_number && depends_on_others(rule) && number && begins_as_unit(number->rest) && !with_decimal_point(value))
      return value;
    std::string kept = is_number ? without_unit(rule, value) : value;
    if (rule.kind == Rule::Kind::numbers)
    {
      std::vector<std::string> given = split(value, ','), parts;
      for (const auto &part : given)
        parts.push_back(without_unit(rule, part));
      kept = parts == given ? value : boost::algorithm::join(parts, ", ");
    }
    if (const auto broken = violation(rule, kept))
      throw InputError(*broken);
    return kept;
  }

  std::vector<double> list_of_numbers(const std::string &value)
  {
    std::vector<double> numbers;
    for (const auto &part : split(value, ','))
      numbers.push_back(leading_number(part)->value);
    return numbers;
  }
} // namespace sprag
