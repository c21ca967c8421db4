// SPDX-License-Identifier: GPL-3.0-only
#include "input/own_units.h"

#include "base/errors.h"
#include "base/text.h"
#include "base/units.h"

#include <boost/algorithm/string/erase.hpp>
#include <boost/algorithm/string/join.hpp>

#include <cmath>

namespace sprag
{
  namespace
  {
    const std::string reference_prefix = "of ";

    /// Returns how many N/mm^n a unit of force over length to the power n holds, as 1000 for "kN/mm^n".
    double stiffness_factor(const std::string &unit, const std::string &exponent)
    {
      const std::string plain = boost::algorithm::erase_all_copy(boost::algorithm::erase_all_copy(unit, "("), ")");
      const auto slash = plain.rfind('/'), power = plain.rfind('^');
      const bool has_power  = power != std::string::npos && slash != std::string::npos && power > slash;
      const auto n          = leading_number(exponent);
      const auto written    = leading_number(has_power ? plain.substr(power + 1) : "1");
      const bool is_general = has_power && trim(plain.substr(power + 1)) == "n";
      if (slash == std::string::npos || !n || (!is_general && (!written || written->value != n->value)))
        throw InputError("'" + unit + "' is no force over length to the power n = " + exponent);
      const auto length = plain.substr(slash + 1, has_power ? power - slash - 1 : std::string::npos);
      return unit_factor(trim(plain.substr(0, slash)), "N") * std::pow(unit_factor(trim(length), "mm"), -n->value);
    }

    /// Returns the words from `begin` on, without those that `end` and what follows are.
    std::string joined_words(const std::vector<std::string> &words, const std::size_t begin, const std::size_t end)
    {
      return boost::algorithm::join(boost::make_iterator_range(&words[begin], &words[0] + end), " ");
    }

    bool begins_number(const std::string &word)
    {
      const auto number = leading_number(word);
      return number && (number->rest.empty() || number->rest.front() != '/');
    }
  } // namespace

  double in_own_unit(const std::vector<Parameter> &declared, const Parameter &parameter, const std::string &text,
                     const LookUp &look_up)
  {
    const Rule &rule = parameter.rule;
    if (rule.unit.rfind(reference_prefix, 0) == 0)
    {
      const Parameter *const named =
          find_parameter(declared, look_up(parameter.section + "/" + rule.unit.substr(reference_prefix.size())));
      const auto number = leading_number(text);
      if (named == nullptr) // which is reported as a mistake of its own
        return number->value;
      return in_own_unit(declared, *named, text, look_up);
    }
    const auto number = leading_number(text);
    Rule any          = rule;
    any.kind          = Rule::Kind::number;
    any.interval      = any_number();
    if (!depends_on_others(rule) || !number || number->rest.empty())
      return leading_number(kept_value(any, text))->value;
    try
    {
      return leading_number(formatted("%.15g", number->value * stiffness_factor(number->rest, look_up("Contact/Exponent"))))
          ->value;
    }
    catch (const InputError &error)
    {
      throw InputError("must be " + description(rule) + " [" + rule.unit + "]: " + error.what());
    }
  }

  std::string ranges_in_own_units(const std::vector<Parameter> &declared, const std::string &text, const LookUp &look_up)
  {
    std::vector<std::string> entries;
    for (const auto &entry : split(text, ';'))
    {
      entries.push_back(entry);
      const auto words = split(single_spaced(entry), ' ');
      for (std::size_t name_end = 1; name_end < words.size(); ++name_end)
      {
        const Parameter *const parameter = find_parameter(declared, joined_words(words, 0, name_end));
        if (parameter == nullptr || !begins_number(words[name_end]))
          continue;
        std::size_t second = name_end + 1;
        while (second < words.size() && !begins_number(words[second]))
          ++second;
        if (second == words.size())
          continue;
        const auto ends = with_common_unit(parameter->rule,
                                           { joined_words(words, name_end, second), joined_words(words, second, words.size()) });
        const auto own  = [&](const std::string &end) { return number_text(in_own_unit(declared, *parameter, end, look_up)); };
        entries.back()  = full_name(*parameter) + ' ' + own(ends[0]) + ' ' + own(ends[1]);
      }
    }
    return boost::algorithm::join(entries, "; ");
  }
} // namespace sprag
