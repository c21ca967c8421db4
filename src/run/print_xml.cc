// SPDX-License-Identifier: GPL-3.0-only
#include "base/errors.h"
#include "input/sections.h"
#include "run/run.h"

#include <deal.II/base/parameter_handler.h>

#include <boost/algorithm/string/join.hpp>

#include <algorithm>
#include <iostream>
#include <memory>

namespace sprag
{
  namespace
  {
    namespace Patterns = dealii::Patterns;

    /// Bounds [low, high] within the numbers of a type.
    template <class Number>
    std::pair<Number, Number> bounds(const Interval &interval)
    {
      constexpr double least = std::numeric_limits<Number>::lowest(), most = std::numeric_limits<Number>::max();
      return { std::clamp(interval.low, least, most), std::clamp(interval.high, least, most) };
    }

    std::unique_ptr<Patterns::PatternBase> pattern(const Rule &rule)
    {
      if (rule.kind == Rule::Kind::choice)
        return std::make_unique<Patterns::Selection>(boost::algorithm::join(rule.choices, "|"));
      if (rule.kind == Rule::Kind::file)
        return std::make_unique<Patterns::FileName>();
      if (rule.kind == Rule::Kind::integer)
      {
        const auto [low, high] = bounds<int>(rule.interval);
        return std::make_unique<Patterns::Integer>(low, high);
      }
      if (rule.kind == Rule::Kind::number && !depends_on_others(rule))
      {
        const auto [low, high] = bounds<double>(rule.interval);
        return std::make_unique<Patterns::Double>(low, high);
      }
      return std::make_unique<Patterns::Anything>();
    }
  } // namespace

  void print_xml(const std::string &text)
  {
    using dealii::ParameterHandler;
    SceneSettings defaults;
    ParameterHandler handler;
    for (const auto &parameter : scene_parameters(defaults))
    {
      handler.enter_subsection(parameter.section);
      handler.declare_entry(parameter.name, parameter.default_value, *pattern(parameter.rule), documentation(parameter));
      handler.leave_subsection();
    }
    try
    {
      handler.parse_input_from_string(text);
    }
    catch (const dealii::ParameterHandler::ExcInvalidEntryForPattern &error)
    {
      throw InputError("--print-parameters: " + error_message(error));
    }
    handler.print_parameters(
        std::cout, static_cast<ParameterHandler::OutputStyle>(ParameterHandler::XML | ParameterHandler::KeepDeclarationOrder));
  }
} // namespace sprag
