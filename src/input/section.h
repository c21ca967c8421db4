// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "base/choices.h"
#include "base/parameters.h"
#include "base/text.h"
#include "input/materials.h"
#include "scene/plane_state.h"

#include <optional>
#include <string>
#include <vector>

namespace sprag
{
  /// Collects the parameters of one section, each bound to the variable it sets.
  struct Section
  {
    std::vector<Parameter> &parameters;
    const std::string name;
    std::string choice_needed = {};
    std::string word_needed   = {};

    /// Returns the section for parameters that count only with a choice in it.
    Section only_with(const std::string &entry, const std::string &word) const
    {
      Section result       = *this;
      result.choice_needed = name + "/" + entry;
      result.word_needed   = word;
      return result;
    }

    void number(const std::string &entry, double &value, const Interval &interval, const std::string &unit,
                const std::string &meaning)
    {
      add(entry, number_text(value), { Rule::Kind::number, interval, unit, {} }, meaning,
          [&value](const auto &text) { value = leading_number(text)->value; });
    }

    /// Adds a number > 0 in mm.
    void length(const std::string &entry, double &value, const std::string &meaning)
    {
      number(entry, value, above(0.), "mm", meaning);
    }

    void integer(const std::string &entry, unsigned int &value, const Interval &interval, const std::string &meaning)
    {
      add(entry, std::to_string(value), { Rule::Kind::integer, interval, "", {} }, meaning,
          [&value](const auto &text) { value = static_cast<unsigned int>(leading_number(text)->value); });
    }

    void number_or_auto(const std::string &entry, std::optional<double> &value, const Interval &interval, const std::string &unit,
                        const std::string &meaning)
    {
      add(entry, value ? number_text(*value) : "auto", { Rule::Kind::number_or_auto, interval, unit, {} }, meaning,
          [&value](const auto &text)
          { value = text == "auto" ? std::nullopt : std::make_optional(leading_number(text)->value); });
    }

    void numbers(const std::string &entry, std::vector<double> &values, const Interval &interval, const std::string &unit,
                 const std::string &meaning)
    {
      std::string text;
      for (const double value : values)
        text += (text.empty() ? "" : ", ") + number_text(value);
      add(entry, text, { Rule::Kind::numbers, interval, unit, {} }, meaning,
          [&values](const auto &list) { values = parse_numbers(list); });
    }

    void text(const std::string &entry, std::string &value, const std::string &meaning, const Rule::Kind kind = Rule::Kind::text)
    {
      add(entry, value, { kind, {}, "", {} }, meaning, [&value](const auto &parsed_value) { value = parsed_value; });
    }

    template <typename T>
    void choice(const std::string &entry, T &value, const Choices<T> &choices, const std::string &meaning)
    {
      add(entry, word_for(choices, value), { Rule::Kind::choice, {}, "", words_in(choices) }, meaning,
          [&value, choices](const auto &text) { value = value_for(choices, text); });
    }

    void add(const std::string &entry, const std::string &value, const Rule &rule, const std::string &meaning,
             const std::function<void(const std::string &)> &store)
    {
      parameters.push_back({ name, entry, value, rule, meaning, store, choice_needed, word_needed });
    }
  };

  /// Adds material and constants of an elastic part; `suffix` names it, as " of the layer".
  template <class Part>
  void add_material(Section &section, Part &part, const std::string &suffix)
  {
    section.add(material_parameter, "none", { Rule::Kind::choice, {}, "", words_in(materials()) },
                "Material of params/materials.md, whose E, nu and rho hold where this section does not set them",
                [](const std::string &) {}); // it is the reader that fills them in
    section.number("Young's modulus", part.young_modulus, above(0.), "MPa", "E" + suffix);
    section.number("Poisson's ratio", part.poisson_ratio, between(-1., 0.5), "", "nu" + suffix);
    section.number("Density", part.density, above(0.), "t/mm3", "rho" + suffix);
  }

  /// Adds the choice of plane stress or strain of a part.
  template <class Part>
  void add_plane(Section &section, Part &part, const std::string &meaning)
  {
    section.choice("Plane", part.plane, { { "stress", PlaneState::stress }, { "strain", PlaneState::strain } }, meaning);
  }
} // namespace sprag
