// SPDX-License-Identifier: GPL-3.0-only
#include "base/parameters.h"

#include "base/errors.h"
#include "base/ranges.h"
#include "base/system/file_content.h"
#include "base/text.h"
#include "base/units.h"

#include <boost/algorithm/string/join.hpp>
#include <boost/algorithm/string/predicate.hpp>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <iomanip>
#include <optional>
#include <sstream>
#include <stdexcept>

namespace sprag
{
  namespace
  {
    constexpr double infinity = std::numeric_limits<double>::infinity();

    bool lies_in(const Interval &interval, const double value)
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
      if (const auto comma = comma_rule(value); comma && rule.kind != Rule::Kind::integer)
        return "must be " + description(rule) + ' ' + *comma;
      if (number && !number->rest.empty())
        return "must be " + description(rule) + " and nothing else";
      const bool whole = rule.kind != Rule::Kind::integer || (number && number->value == std::floor(number->value));
      if (!number || !whole || !lies_in(rule.interval, number->value))
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
      if (!number || !begins_as_unit(number->rest))
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

    constexpr std::size_t comment_width = 74;

    /// An entry as it is printed.
    struct Entry
    {
      const Parameter &parameter;
      std::string value;
      std::string written; ///< with a unit; empty where it had none
      bool is_open;        ///< whether the line is a comment
    };

    void print(std::ostream &text, const std::string &section, const std::vector<Entry> &entries)
    {
      int name = 0, value = 0;
      for (const auto &entry : entries)
      {
        name  = std::max(name, static_cast<int>(entry.parameter.name.size()));
        value = std::max(value, static_cast<int>(entry.value.size()));
      }
      text << "subsection " << section << '\n' << std::left;
      for (const auto &entry : entries)
      {
        const Parameter &parameter = entry.parameter;
        if (&entry != &entries.front())
          text << '\n';
        for (const auto &line : split_lines(documentation(parameter), comment_width))
          text << "  # " << line << '\n';
        text << (entry.is_open ? "  #set " : "  set ") << std::setw(name) << parameter.name << " = ";
        const std::string by_default = escaped(parameter.default_value);
        const std::string written    = entry.written.empty() ? "" : "given as " + escaped(entry.written);
        const std::string usual      = entry.value == by_default ? "" : "default: " + by_default;
        if (written.empty() && usual.empty())
          text << entry.value << '\n';
        else
          text << std::setw(value) << entry.value << " # " << written << (written.empty() || usual.empty() ? "" : "; ") << usual
               << '\n';
      }
      text << "end\n\n\n";
    }

    /// A line of the file, continued ones joined, without its comment.
    struct Statement
    {
      unsigned int line;
      std::string text;
    };

    std::vector<Statement> statements(std::istream &input)
    {
      std::vector<Statement> result;
      std::string joined;
      unsigned int first = 0;
      unsigned int line  = 0;
      for (std::string text; std::getline(input, text);)
      {
        ++line;
        first = joined.empty() ? line : first;
        joined += trim(text);
        if (!joined.empty() && joined.back() == '\\' && !input.eof())
        {
          joined.back() = ' ';
          continue;
        }
        const std::string statement = trim(joined.substr(0, joined.find('#')));
        if (!statement.empty())
          result.push_back({ first, statement });
        joined.clear();
      }
      return result;
    }

    /// Everything behind a keyword; none where the text begins with another one.
    std::optional<std::string> behind(const std::string &keyword, const std::string &text)
    {
      const bool same = boost::algorithm::iequals(keyword, text.substr(0, text.find_first_of(" \t")));
      return same ? std::make_optional(trim(text.substr(keyword.size()))) : std::nullopt;
    }

    /// Reads parameter files and overrides into settings.
    struct Reader
    {
      const std::vector<Parameter> &declared;
      Settings &settings;
      std::optional<std::string> section = {}; ///< none outside; the closest declared one where the name is misspelt
      bool section_known                 = false;
      std::string section_place          = {};

      void mistake(const std::string &place, const std::string &what, const std::string &rule)
      {
        settings.mistakes.push_back(place + ": " + what + ": " + rule);
      }

      void read_file()
      {
        try
        {
          std::istringstream input(read_whole_file(settings.file, largest_scene));
          read_all(input);
        }
        catch (const InputError &error)
        {
          settings.mistakes.push_back(error.what());
          for (const auto &parameter : declared)
            settings.invalid.insert(full_name(parameter));
        }
      }

      void read_all(std::istream &input)
      {
        const std::vector<Statement> all = statements(input);
        if (std::any_of(all.begin(), all.end(), [](const auto &s) { return s.text.find('\0') != std::string::npos; }))
          throw InputError(settings.file + ": is not a text: must be a parameter file");

        for (const auto &statement : all)
          read(settings.file + ":" + std::to_string(statement.line), statement.text);
        if (section)
          mistake(section_place, "subsection " + *section, "must be closed by a line 'end'");
        section.reset();
      }

      void read(const std::string &place, const std::string &text)
      {
        if (const auto name = behind("subsection", text))
          open(place, single_spaced(*name));
        else if (const auto assignment = behind("set", text))
          set(place, *assignment);
        else if (const auto rest = behind("end", text))
          close(place, *rest);
        else if (behind("include", text))
          mistake(place, text, "other files are not included: write their lines here or use --set");
        else
          mistake(place, text,
                  "must begin with subsection, set, end or #" +
                      did_you_mean(nearest(text.substr(0, text.find_first_of(" \t")), { "subsection", "set", "end" })));
      }

      void open(const std::string &place, const std::string &name)
      {
        if (section)
          mistake(place, "subsection " + name, "subsection " + *section + " must be closed by a line 'end' before it");
        const auto match = closest_section(name);
        section_known    = match.has_value();
        if (!section_known || *match != name)
          mistake(place, "subsection " + name, "no such subsection" + did_you_mean(match));
        section       = match.value_or(name);
        section_place = place;
      }

      void close(const std::string &place, const std::string &rest)
      {
        if (!rest.empty())
          mistake(place, "end " + rest, "'end' must stand alone");
        if (!section)
          mistake(place, "end", "no subsection is open");
        section.reset();
      }

      void set(const std::string &place, const std::string &text)
      {
        const auto equals = text.find('=');
        if (equals == std::string::npos)
          return mistake(place, "set " + text, "must have the form set Name = value");
        const std::string name  = single_spaced(text.substr(0, equals));
        const std::string value = unescaped(trim(text.substr(equals + 1)));
        if (!section)
          unknown_name(place, name, value);
        else if (section_known)
          assign(place, *section + "/" + name, value, false);
      }

      void read_overrides(const std::vector<std::string> &overrides)
      {
        for (const auto &text : overrides)
          read_override(text);
      }

      void read_override(const std::string &text)
      {
        const auto equals = text.find('=');
        const auto slash  = text.find('/');
        if (equals == std::string::npos || slash > equals)
          return mistake("--set", text, "must have the form Section/Name=value");
        const std::string written_section = single_spaced(text.substr(0, slash));
        const std::string name            = single_spaced(text.substr(slash + 1, equals - slash - 1));
        const std::string value           = trim(text.substr(equals + 1));
        const auto match                  = closest_section(written_section);
        if (!match || *match != written_section)
          mistake("--set", written_section + "/" + name + " = " + value, "no such section" + did_you_mean(match));
        if (match)
          assign("--set", *match + "/" + name, value, true);
      }

      void assign(const std::string &place, const std::string &name, const std::string &value, const bool again_allowed)
      {
        const Parameter *found = find_parameter(declared, name);
        if (found == nullptr)
          return unknown_name(place, name, value);

        if (const auto before = settings.specified.find(name); before != settings.specified.end() && !again_allowed)
          mistake(place, name + " = " + value, "must be set once only, it is at " + before->second.place + " already");
        else
          try
          {
            const auto kept          = kept_value(found->rule, value);
            settings.specified[name] = { place, kept, kept == value ? "" : value };
          }
          catch (const InputError &broken)
          {
            mistake(place, name + " = " + value, broken.what() + other_choice(*found, value));
            settings.invalid.insert(name);
          }
      }

      /// Names the one other parameter of the section that has this choice.
      std::string other_choice(const Parameter &parameter, const std::string &value) const
      {
        const auto others = filtered(declared, [&](const auto &other)
                                     { return other.section == parameter.section && contains(other.rule.choices, value); });
        return others.size() == 1 ? "; " + full_name(others[0]) + " can be " + value : "";
      }

      /// `name`: with its section, or alone outside of sections.
      void unknown_name(const std::string &place, const std::string &name, const std::string &value)
      {
        const auto slash       = name.find('/');
        const std::string own  = slash == std::string::npos ? "" : name.substr(0, slash);
        const std::string last = slash == std::string::npos ? name : name.substr(slash + 1);
        std::optional<std::string> match;
        std::vector<std::string> names;
        for (const auto &parameter : declared)
        {
          if (parameter.name == last)
            match = full_name(parameter);
          if (parameter.section == own)
            names.push_back(parameter.name);
        }
        if (const auto near = nearest(last, names); near && !match)
        {
          match = near;
          settings.invalid.insert(own + "/" + *near);
        }
        mistake(place, name + " = " + value,
                (own.empty() ? "must stand inside a subsection" : "no such parameter") + did_you_mean(match));
      }

      std::optional<std::string> closest_section(const std::string &name) const
      {
        std::vector<std::string> sections;
        for (const auto &parameter : declared)
          if (parameter.section == name)
            return name;
          else if (sections.empty() || sections.back() != parameter.section)
            sections.push_back(parameter.section);
        return nearest(name, sections);
      }
    };
  } // namespace

  bool depends_on_others(const Rule &rule)
  {
    return boost::starts_with(rule.unit, "of ") || boost::ends_with(rule.unit, "^n");
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
      if (contains(rule.choices, value))
        return std::nullopt;
      return "must be " + description(rule) + did_you_mean(nearest(value, rule.choices));
    case Rule::Kind::text:
    case Rule::Kind::file:
      break;
    }
    return std::nullopt;
  }

  std::string kept_value(const Rule &rule, const std::string &value)
  {
    const auto number = leading_number(value);
    if (is_number(rule) && depends_on_others(rule) && number && begins_as_unit(number->rest))
      return value;
    std::string kept = is_number(rule) ? without_unit(rule, value) : value;
    if (rule.kind == Rule::Kind::numbers)
    {
      if (const auto unclear = list_comma_rule(value))
        throw InputError(*unclear);
      const auto specified = split(value, ',');
      const auto parts = mapped(with_common_unit(rule, specified), [&](const auto &part) { return without_unit(rule, part); });
      kept             = parts == specified ? value : boost::algorithm::join(parts, ", ");
    }
    if (const auto broken = violation(rule, kept))
      throw InputError(*broken);
    return kept;
  }

  std::vector<std::string> with_common_unit(const Rule &rule, const std::vector<std::string> &numbers)
  {
    std::set<std::string> units;
    std::string last;
    for (const auto &text : numbers)
      if (const auto number = leading_number(text); number && (number->rest.empty() || begins_as_unit(number->rest)))
        units.insert(last = number->rest);
    if (units.size() < 2 || units.count("") == 0)
      return numbers;
    if (last.empty() || units.size() > 2 || rule.unit.empty())
      throw InputError("has numbers with and without unit: " +
                       std::string(rule.unit.empty() ? "each must have one, or none"
                                                     : "each must have one, or the last alone, whose unit is that of all"));
    return mapped(numbers, [&](const auto &text) { return number_alone(text) ? text + ' ' + last : text; });
  }

  std::vector<double> parse_numbers(const std::string &value)
  {
    return mapped(split(value, ','), [](const auto &part) { return leading_number(part)->value; });
  }

  const Parameter *find_parameter(const std::vector<Parameter> &declared, const std::string &name)
  {
    return find_by(declared, full_name, name);
  }

  std::string documentation(const Parameter &parameter)
  {
    const Rule &rule       = parameter.rule;
    const bool any_text    = rule.kind == Rule::Kind::text || rule.kind == Rule::Kind::file;
    const bool has_number  = rule.kind != Rule::Kind::choice && !any_text;
    const std::string unit = has_number ? " [" + (rule.unit.empty() ? "-" : rule.unit) + "]" : "";
    return parameter.meaning + unit + (any_text ? "." : ": " + description(rule) + ".");
  }

  Settings read_settings(const std::string &file, const std::vector<std::string> &overrides,
                         const std::vector<Parameter> &declared)
  {
    Settings settings{ file, {}, {}, {} };
    Reader reader{ declared, settings };
    reader.read_file();
    reader.read_overrides(overrides);
    return settings;
  }

  Settings override_settings(const std::string &file, const ParameterValues &values, const std::vector<std::string> &overrides,
                             const std::vector<Parameter> &declared)
  {
    Settings settings{ file, {}, {}, {} };
    for (const auto &[name, value] : values)
      settings.specified[name] = { file, value };
    Reader{ declared, settings }.read_overrides(overrides);
    return settings;
  }

  void add_mistake(Settings &settings, const std::vector<Parameter> &declared, const std::string &name, const std::string &rule)
  {
    const Parameter *parameter = find_parameter(declared, name);
    if (parameter == nullptr)
      throw std::logic_error(name + " is not declared");
    const auto specified = settings.specified.find(name);
    const Setting setting =
        specified == settings.specified.end() ? Setting{ settings.file, parameter->default_value } : specified->second;
    const auto &value = setting.written.empty() ? setting.value : setting.written;
    settings.mistakes.push_back(setting.place + ": " + name + " = " + value + ": " + rule);
  }

  std::string parameters_text(const std::vector<Parameter> &declared, const ParameterValues &specified,
                              const ParameterValues &written, const std::set<std::string> &open)
  {
    std::vector<std::string> sections;
    std::map<std::string, std::vector<Entry>> entries;
    for (const auto &parameter : declared)
    {
      const auto value = specified.find(full_name(parameter));
      const auto text  = written.find(full_name(parameter));
      if (entries.count(parameter.section) == 0)
        sections.push_back(parameter.section);
      entries[parameter.section].push_back({ parameter,
                                             escaped(value == specified.end() ? parameter.default_value : value->second),
                                             text == written.end() ? "" : text->second, open.count(full_name(parameter)) > 0 });
    }
    std::ostringstream text;
    text << "# Listing of Parameters\n# ---------------------\n";
    for (const auto &section : sections)
      print(text, section, entries.at(section));
    return text.str();
  }
} // namespace sprag
