// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "base/choices.h"
#include "base/pages.h"
#include "base/parameters.h"
#include "base/ranges.h"
#include "base/text.h"
#include "scene/plane_state.h"

#include <boost/algorithm/string/join.hpp>
#include <optional>
#include <string>
#include <vector>

namespace sprag
{
  /// The name of the parameter that names the material of a section.
  constexpr const char *material_parameter = "Made of";

  /// Returns the rows of params/materials.md by the names of the materials, in the page's order behind "none", which is empty.
  /// Cells of parameters bear the parameter's name; a number there may have a unit, as in "210 GPa".
  const Choices<PageCells> &materials();

  /// Collects the parameters of one section, each bound to the variable it sets. Their meanings are those of
  /// params/parameters.md.
  struct Section
  {
    std::vector<Parameter> &parameters;
    const std::string name;
    std::string choice_needed = {};
    std::string word_needed   = {};
    const PageTable &page     = page_table("parameter", "## " + name);

    /// Returns the section for parameters that count only with a choice in it.
    Section only_with(const std::string &entry, const std::string &word) const
    {
      Section result       = *this;
      result.choice_needed = name + "/" + entry;
      result.word_needed   = word;
      return result;
    }

    void number(const std::string &entry, double &value, const Interval &interval, const std::string &unit = "")
    {
      add(entry, number_text(value), { Rule::Kind::number, interval, unit, {} },
          [&value](const auto &text) { value = leading_number(text)->value; });
    }

    /// Adds a number > 0 in mm.
    void length(const std::string &entry, double &value)
    {
      number(entry, value, above(0.), "mm");
    }

    void integer(const std::string &entry, unsigned int &value, const Interval &interval)
    {
      add(entry, std::to_string(value), { Rule::Kind::integer, interval, "", {} },
          [&value](const auto &text) { value = static_cast<unsigned int>(leading_number(text)->value); });
    }

    void number_or_auto(const std::string &entry, std::optional<double> &value, const Interval &interval,
                        const std::string &unit = "")
    {
      add(entry, value ? number_text(*value) : "auto", { Rule::Kind::number_or_auto, interval, unit, {} },
          [&value](const auto &text)
          { value = text == "auto" ? std::nullopt : std::make_optional(leading_number(text)->value); });
    }

    void numbers(const std::string &entry, std::vector<double> &values, const Interval &interval, const std::string &unit = "")
    {
      add(entry, boost::algorithm::join(mapped(values, number_text), ", "), { Rule::Kind::numbers, interval, unit, {} },
          [&values](const auto &list) { values = parse_numbers(list); });
    }

    void text(const std::string &entry, std::string &value, const Rule::Kind kind = Rule::Kind::text)
    {
      add(entry, value, { kind, {}, "", {} }, [&value](const auto &parsed_value) { value = parsed_value; });
    }

    template <typename T>
    void choice(const std::string &entry, T &value, const Choices<T> &choices)
    {
      add(entry, word_for(choices, value), { Rule::Kind::choice, {}, "", words_in(choices) },
          [&value, choices](const auto &text) { value = value_for(choices, text); });
    }

    /// Adds a choice among all values of an enumeration, whose words are their names with blanks.
    template <typename T>
    void choice(const std::string &entry, T &value)
    {
      choice(entry, value, enumerator_words<T>());
    }

    /// Throws std::out_of_range where the page has no such parameter.
    void add(const std::string &entry, const std::string &value, const Rule &rule,
             const std::function<void(const std::string &)> &store)
    {
      const auto &cells = value_for(page.rows, entry);
      parameters.push_back({ name, entry, value, rule, cells.at("meaning"), store, choice_needed, word_needed });
    }
  };

  /// Adds material and constants of an elastic part.
  template <class Part>
  void add_material(Section &section, Part &part)
  {
    section.add(material_parameter, "none", { Rule::Kind::choice, {}, "", words_in(materials()) },
                [](const std::string &) {}); // it is the reader that fills them in
    section.number("Young's modulus", part.young_modulus, above(0.), "MPa");
    section.number("Poisson's ratio", part.poisson_ratio, between(-1., 0.5));
    section.number("Density", part.density, above(0.), "t/mm3");
  }

} // namespace sprag
