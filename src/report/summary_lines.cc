// SPDX-License-Identifier: GPL-3.0-only
#include "report/summary_lines.h"

#include "base/text.h"
#include "input/sections.h"
#include "scene/scene.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <ostream>

namespace sprag
{
  std::string padded(const std::string &text, const int width)
  {
    const auto size = static_cast<std::size_t>(std::abs(width));
    const std::string blanks(size - std::min(size, text.size()), ' ');
    return width < 0 ? text + blanks : blanks + text;
  }

  double rounded_to(const double value, const bool upward)
  {
    constexpr double slack = 1e-6; // of the last digit, for numbers that have four already
    const double unit      = std::pow(10., std::floor(std::log10(std::abs(value))) - 3.);
    return value == 0. ? 0. : unit * (upward ? std::ceil(value / unit - slack) : std::floor(value / unit + slack));
  }

  std::string with_unit(const double value, const std::string &unit)
  {
    return four_digits(value) + (unit.empty() || unit == "1" ? "" : ' ' + unit);
  }

  std::string parameter_unit(const std::string &name)
  {
    SceneSettings settings;
    const auto parameters       = scene_parameters(settings);
    const auto *const parameter = find_parameter(parameters, name);
    return parameter == nullptr || parameter->rule.unit.empty() ? "1" : parameter->rule.unit;
  }

  void summary_line(std::ostream &stream, const std::string &label, const std::string &text)
  {
    constexpr std::size_t label_width = 22;
    std::string padded_label          = label;
    padded_label.resize(std::max(label_width, label.size() + 2), ' ');
    stream << "  " << (text.empty() ? label : padded_label + text) << '\n';
  }
} // namespace sprag
