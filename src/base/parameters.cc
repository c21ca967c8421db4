// SPDX-License-Identifier: GPL-3.0-only
#include "base/parameters.h"

#include "base/errors.h"
#include "base/escaped.h"
#include "base/file_content.h"
#include "base/text.h"

#include <boost/algorithm/string/predicate.hpp>

#include <algorithm>
#include <optional>
#include <sstream>
#include <stdexcept>

namespace sprag
{
  namespace
  {
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
      std::optional<std::string> section = {}; ///< none outside; the declared one meant where the name is misspelt
      bool section_known                 = false;
      std::string section_place          = {};

      void mistake(const std::string &place, const std::string &what, const std::string &rule)
      {
        settings.mistakes.push_back(place + ": " + what + ": " + rule);
      }

      void unusable(const std::string &rule)
      {
        settings.mistakes.push_back(settings.file + ": " + rule);
        doubt_all();
      }

      void doubt_all()
      {
        for (const auto &parameter : declared)
          settings.doubtful.insert(full_name(parameter));
      }

      void read_file()
      {
        try
        {
          std::istringstream input(content_of_file(settings.file, largest_scene));
          read_all(input);
        }
        catch (const InputError &error)
        {
          settings.mistakes.push_back(error.what());
          doubt_all();
        }
      }

      void read_all(std::istream &input)
      {
        const std::vector<Statement> all = statements(input);
        if (std::any_of(all.begin(), all.end(), [](const auto &s) { return s.text.find('\0') != std::string::npos; }))
          return unusable("is not a text: must be a parameter file");

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
        const auto meant = section_meant(name);
        section_known    = meant.has_value();
        if (!section_known || *meant != name)
          mistake(place, "subsection " + name, "no such subsection" + did_you_mean(meant));
        section       = meant.value_or(name);
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
        const std::string given_section = single_spaced(text.substr(0, slash));
        const std::string name          = single_spaced(text.substr(slash + 1, equals - slash - 1));
        const std::string value         = trim(text.substr(equals + 1));
        const auto meant                = section_meant(given_section);
        if (!meant || *meant != given_section)
          mistake("--set", given_section + "/" + name + " = " + value, "no such section" + did_you_mean(meant));
        if (meant)
          assign("--set", *meant + "/" + name, value, true);
      }

      void assign(const std::string &place, const std::string &name, const std::string &value, const bool again_allowed)
      {
        const Parameter *found = find_parameter(declared, name);
        if (found == nullptr)
          return unknown_name(place, name, value);

        if (const auto before = settings.given.find(name); before != settings.given.end() && !again_allowed)
          mistake(place, name + " = " + value, "must be set once only, it is at " + before->second.place + " already");
        else
          try
          {
            const auto kept      = kept_value(found->rule, value);
            settings.given[name] = { place, kept, kept == value ? "" : value };
          }
          catch (const InputError &broken)
          {
            mistake(place, name + " = " + value, broken.what());
            settings.doubtful.insert(name);
          }
      }

      /// `name` with its section, or alone where it stands outside any.
      void unknown_name(const std::string &place, const std::string &name, const std::string &value)
      {
        const auto slash       = name.find('/');
        const std::string own  = slash == std::string::npos ? "" : name.substr(0, slash);
        const std::string last = slash == std::string::npos ? name : name.substr(slash + 1);
        std::optional<std::string> meant;
        std::vector<std::string> names;
        for (const auto &parameter : declared)
        {
          if (parameter.name == last)
            meant = full_name(parameter);
          if (parameter.section == own)
            names.push_back(parameter.name);
        }
        if (const auto near = nearest(last, names); near && !meant)
        {
          meant = near;
          settings.doubtful.insert(own + "/" + *near);
        }
        mistake(place, name + " = " + value,
                (own.empty() ? "must stand inside a subsection" : "no such parameter") + did_you_mean(meant));
      }

      std::optional<std::string> section_meant(const std::string &name) const
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

  std::string full_name(const Parameter &parameter)
  {
    return parameter.section + "/" + parameter.name;
  }

  const Parameter *find_parameter(const std::vector<Parameter> &declared, const std::string &name)
  {
    const auto meant = [&](const Parameter &parameter) { return full_name(parameter) == name; };
    const auto found = std::find_if(declared.begin(), declared.end(), meant);
    return found == declared.end() ? nullptr : &*found;
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
      settings.given[name] = { file, value };
    Reader{ declared, settings }.read_overrides(overrides);
    return settings;
  }

  void add_mistake(Settings &settings, const std::vector<Parameter> &declared, const std::string &name, const std::string &rule)
  {
    const Parameter *parameter = find_parameter(declared, name);
    if (parameter == nullptr)
      throw std::logic_error(name + " is not declared");
    const auto given      = settings.given.find(name);
    const Setting setting = given == settings.given.end() ? Setting{ settings.file, parameter->default_value } : given->second;
    const auto &value     = setting.written.empty() ? setting.value : setting.written;
    settings.mistakes.push_back(setting.place + ": " + name + " = " + value + ": " + rule);
  }
} // namespace sprag
