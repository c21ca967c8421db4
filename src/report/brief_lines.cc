// SPDX-License-Identifier: GPL-3.0-only
#include "report/brief_lines.h"

#include "base/text.h"
#include "report/percent.h"
#include "scene/scene.h"
#include "scene/sections.h"

#include <cmath>
#include <map>
#include <ostream>

namespace sprag
{
  namespace
  {
    constexpr int label_width = 22;
  }

  Known::Known(const std::vector<Entry> &entries)
  {
    for (const auto &entry : entries)
    {
      const auto *const number = std::get_if<double>(&entry.value);
      if (number == nullptr || !std::isnan(*number))
        known.emplace(entry.name, &entry);
    }
  }

  std::optional<double> Known::number(const std::string &name) const
  {
    const auto found = known.find(name);
    return found == known.end() ? std::optional<double>() : std::get<double>(found->second->value);
  }

  std::string Known::text(const std::string &name) const
  {
    const auto found = known.find(name);
    return found == known.end() ? "" : std::get<std::string>(found->second->value);
  }

  std::string Known::quantity(const std::string &name) const
  {
    const auto found = known.find(name);
    return found == known.end() ? "-" : with_unit(std::get<double>(found->second->value), found->second->unit);
  }

  std::string Known::share(const std::string &name) const
  {
    const auto value = number(name);
    return value ? formatted("%.3g", 100. * std::abs(*value)) + " %" : "-";
  }

  std::string padded(const std::string &text, const int width)
  {
    return formatted("%*s", width, text.c_str());
  }

  std::string four_digits(const std::optional<double> &value)
  {
    return value ? formatted("%.4g", *value) : "-";
  }

  std::string with_unit(const double value, const std::string &unit)
  {
    return four_digits(value) + (unit.empty() || unit == "1" ? "" : ' ' + unit);
  }

  std::string unit_of_parameter(const std::string &name)
  {
    SceneSettings settings;
    const auto parameters       = scene_parameters(settings);
    const auto *const parameter = find_parameter(parameters, name);
    return parameter == nullptr ? "" : parameter->rule.unit;
  }

  void brief_line(std::ostream &stream, const std::string &label, const std::string &text)
  {
    const bool is_short = label.size() < label_width;
    stream << "  " << (text.empty() ? label : padded(label, is_short ? -label_width : 0) + (is_short ? "" : "  ") + text) << '\n';
  }

  void print_brief_errors(std::ostream &stream, const std::vector<ErrorEstimate> &errors)
  {
    std::string told;
    std::map<std::string, std::string> untold; // quantities by the reason why nothing is told of them
    const ErrorEstimate *worst = nullptr;
    for (const auto &error : errors)
    {
      if (error.parts.empty())
        untold[error.unknown] += (untold[error.unknown].empty() ? "" : ", ") + error.quantity;
      else
        told += (told.empty() ? "" : ", ") + error.quantity + ' ' + percent(total_error(error));
      if (!error.parts.empty() && (worst == nullptr || total_error(error) > total_error(*worst)))
        worst = &error;
    }
    if (!told.empty())
      brief_line(stream, "errors, estimated", told);
    for (const auto &[reason, quantities] : untold)
      brief_line(stream, "not estimated", quantities + ": " + reason);
    if (worst != nullptr)
      brief_line(stream, "to improve the worst", largest_part(*worst).remedy);
  }

  void print_brief_cost(std::ostream &stream, const Known &known, const double cpu_seconds)
  {
    const auto steps = known.number("steps");
    brief_line(stream, "cost",
               formatted("%.2g", cpu_seconds) + " s of CPU time" + (steps ? ", " + formatted("%.0f", *steps) + " steps" : ""));
  }
} // namespace sprag
