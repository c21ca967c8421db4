// SPDX-License-Identifier: GPL-3.0-only
#include "input/variation.h"

#include "base/errors.h"
#include "base/ranges.h"
#include "base/text.h"

#include <boost/algorithm/string/join.hpp>

#include <cmath>
#include <filesystem>
#include <set>

namespace sprag
{
  namespace
  {
    const std::string dots = "...";

    /// A number between two others, as short as can be.
    std::string short_text(const double value, const int digits)
    {
      return number_text(leading_number(formatted("%.*g", digits, value))->value);
    }

    /// A number alone or with a unit, in that of the rule; none where the text is another.
    std::optional<double> number_in_unit(const Rule &rule, const std::string &text)
    {
      const auto number = leading_number(text);
      return number && !number->rest.empty() ? number_alone(kept_value(rule, text)) : number_alone(text);
    }

    /// FIRST ... LAST : NUMBER [log]
    struct RangeText
    {
      std::string first, last, count;
    };

    /// None where a colon is missing.
    std::optional<RangeText> split_range(const std::string &text)
    {
      const auto middle = text.find(dots);
      const auto colon  = text.find(':', middle);
      if (middle == std::string::npos || colon == std::string::npos)
        return std::nullopt;
      const auto behind = middle + dots.size();
      return RangeText{ trim(text.substr(0, middle)), trim(text.substr(behind, colon - behind)), trim(text.substr(colon + 1)) };
    }

    /// The items of a list with the unit that stands on the last number; ends of ranges are numbers of it.
    std::vector<std::string> items_with_units(const Rule &rule, const std::vector<std::string> &items)
    {
      std::vector<std::string> numbers;
      for (const auto &item : items)
        if (const auto range = split_range(item))
          append(numbers, { range->first, range->last });
        else
          numbers.push_back(item);
      numbers = with_common_unit(rule, numbers);
      std::vector<std::string> result;
      auto number = numbers.begin();
      for (const auto &item : items)
        if (const auto range = split_range(item))
        {
          const auto &first = *number++, &last = *number++;
          result.push_back(first == range->first && last == range->last ? item : first + " ... " + last + " : " + range->count);
        }
        else
          result.push_back(*number++);
      return result;
    }

    /// The values of a range; none where the text is another. Throws InputError where a unit does not fit.
    std::vector<std::string> range_values(const Rule &rule, const std::string &text)
    {
      const auto range = split_range(text);
      if (!range)
        return {};
      const auto first = number_in_unit(rule, range->first);
      const auto last  = number_in_unit(rule, range->last);
      const auto count = leading_number(range->count);
      if (!first || !last || !count || (!count->rest.empty() && count->rest != "log"))
        return {};
      const bool by_ratio = count->rest == "log";
      const double n      = count->value;
      if (n < 2. || n > most_runs || n != std::floor(n) || (by_ratio && !(*first > 0. && *last > 0.)))
        return {};
      std::vector<std::string> values = { number_text(*first) };
      for (double i = 1.; i < n - 1.; ++i)
      {
        const double share = i / (n - 1.);
        values.push_back(by_ratio ? short_text(*first * std::pow(*last / *first, share), 6)
                                  : short_text(*first + share * (*last - *first), 12));
      }
      values.push_back(number_text(*last));
      return values;
    }

    /// Reads one of the two kinds of text.
    struct VariationReader
    {
      const std::vector<Parameter> &declared;
      const std::string &folder;
      const bool lists;
      Variation result = {};

      void mistake(const std::string &what)
      {
        result.mistakes.push_back(what);
      }

      void read(const std::string &text)
      {
        std::set<std::string> seen;
        for (const auto &part : split_all(text, ';'))
        {
          const auto equals = part.find('=');
          if (part.empty())
            continue;
          if (equals == std::string::npos)
          {
            mistake("'" + part + "' must have the form Section/Name = " + (lists ? "VALUES" : "VALUE"));
            continue;
          }
          const std::string name = single_spaced(part.substr(0, equals));
          if (!seen.insert(name).second)
            mistake(name + " must be there once only");
          else if (const Parameter *parameter = declared_parameter(name))
            take(*parameter, trim(part.substr(equals + 1)));
        }
      }

      const Parameter *declared_parameter(const std::string &name)
      {
        const Parameter *found = find_parameter(declared, name);
        if (found == nullptr)
        {
          mistake("'" + name + "' is no parameter" + did_you_mean(nearest_name(name)));
          return nullptr;
        }
        if (const auto reason = reason_against(*found); !reason.empty())
        {
          mistake(name + " " + reason);
          return nullptr;
        }
        return found;
      }

      /// Returns the full name of a parameter given without section, else the most similar one.
      std::optional<std::string> nearest_name(const std::string &name) const
      {
        std::vector<std::string> names;
        for (const auto &parameter : declared)
        {
          if (parameter.name == name)
            return full_name(parameter);
          names.push_back(full_name(parameter));
        }
        return nearest(name, names);
      }

      std::string reason_against(const Parameter &parameter) const
      {
        if (full_name(parameter) == "Analysis/Type")
          return "is Study/Type in a study";
        if (parameter.section == "Map" || parameter.section == "Study")
          return "belongs to no run of a study";
        if (parameter.section == "Output")
          return "does not count: the runs of a study write no fields and estimate no errors";
        if (lists && parameter.rule.kind == Rule::Kind::numbers)
          return "holds a list itself and cannot be varied";
        return {};
      }

      void take(const Parameter &parameter, const std::string &text)
      {
        VariedParameter varied{ full_name(parameter), {} };
        for (const auto &item : lists ? list_items(text, parameter) : std::vector<std::string>{ text })
          if (lists && is_number(parameter.rule) && item.find(dots) != std::string::npos)
            take_range(item, parameter, varied);
          else
            take_value(item, parameter, varied);
        result.parameters.push_back(varied);
      }

      /// Empty after a mistake.
      std::vector<std::string> list_items(const std::string &text, const Parameter &parameter)
      {
        const auto items = split_all(text, ',');
        try
        {
          if (!is_number(parameter.rule))
            return items;
          if (const auto unclear = list_comma_rule(text))
            throw InputError(*unclear);
          return items_with_units(parameter.rule, items);
        }
        catch (const InputError &broken)
        {
          mistake(full_name(parameter) + " = " + text + " " + broken.what());
          return {};
        }
      }

      void take_range(const std::string &item, const Parameter &parameter, VariedParameter &varied)
      {
        std::vector<std::string> values;
        try
        {
          values = range_values(parameter.rule, item);
        }
        catch (const InputError &broken)
        {
          return mistake(varied.name + " = " + item + " " + broken.what());
        }
        if (values.empty())
          mistake(varied.name + " = " + item +
                  " must have the form FIRST ... LAST : NUMBER, with an integer >= 2, or FIRST ... LAST : NUMBER log between "
                  "numbers > 0");
        for (const auto &value : values)
          if (!take_value(value, parameter, varied))
            return; // the others break the rule as well
      }

      bool take_value(const std::string &value, const Parameter &parameter, VariedParameter &varied)
      {
        try
        {
          const auto kept = kept_value(parameter.rule, value);
          if (const auto broken = violation(parameter.rule, kept))
            throw InputError(*broken); // a unit that depends on other parameters
          const bool is_path = parameter.rule.kind == Rule::Kind::file && !value.empty();
          varied.values.push_back(is_path ? (std::filesystem::path(folder) / value).lexically_normal().string() : kept);
          return true;
        }
        catch (const InputError &broken)
        {
          mistake(varied.name + " = " + value + " " + broken.what());
          return false;
        }
      }
    };

  } // namespace

  Variation parse_variation(const std::string &text, const std::vector<Parameter> &declared, const std::string &folder,
                            const bool lists)
  {
    VariationReader reader{ declared, folder, lists };
    reader.read(text);
    auto &result = reader.result;
    if (lists && result.parameters.empty() && result.mistakes.empty())
      result.mistakes.push_back("must name a parameter and its values: Section/Name = VALUES");
    return result;
  }

  std::vector<std::string> combination_mistakes(const StudySettings &study)
  {
    double product = 1.;
    std::set<std::size_t> lengths;
    std::vector<std::string> counts;
    for (const auto &[name, values] : study.varied)
    {
      product *= static_cast<double>(values.size());
      lengths.insert(values.size());
      counts.push_back(name + " has " + std::to_string(values.size()));
    }
    if (study.combine == Combination::list && lengths.size() > 1)
      return { "must give each parameter as many values with Combine = list: " + boost::algorithm::join(counts, ", ") };
    if (study.combine == Combination::grid && product > most_runs)
      return { "makes " + rounded_text(product) + " runs, of which a study may have " + rounded_text(most_runs) };
    return {};
  }

  std::vector<std::string> reference_mistakes(const StudySettings &study)
  {
    if (study.reference.empty() || study.type != AnalysisType::slope)
      return {};
    return { "must be empty where Type = slope: curves of the closed form have no error" };
  }

  std::string variation_text(const std::vector<VariedParameter> &parameters)
  {
    const auto text = [](const VariedParameter &varied)
    { return varied.name + " = " + boost::algorithm::join(varied.values, ", "); };
    return boost::algorithm::join(mapped(parameters, text), "; ");
  }
} // namespace sprag
