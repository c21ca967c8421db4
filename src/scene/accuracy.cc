// SPDX-License-Identifier: GPL-3.0-only
#include "scene/accuracy.h"

#include "scene/scene.h"

#include <boost/algorithm/string.hpp>

namespace sprag
{
  std::vector<std::string> accuracy_quantities(const AnalysisType type)
  {
    if (type == AnalysisType::quasi_static)
      return { "P", "Q", "loop_area", "largest_pressure", "contact_width", "largest_stress" };
    if (type == AnalysisType::transient)
      return { "P", "overshoot", "frequency" };
    if (type == AnalysisType::stability || type == AnalysisType::sprag_slip)
      return { "growth_rate", "frequency" };
    return {};
  }

  std::vector<std::string> quantities_meant(const std::string &text, const AnalysisType type)
  {
    if (text != "auto")
    {
      std::vector<std::string> words;
      boost::split(words, text, [](const char c) { return c == ','; });
      for (auto &word : words)
        boost::trim(word);
      return words;
    }
    if (type == AnalysisType::quasi_static)
      return { "P", "Q", "loop_area" };
    if (type == AnalysisType::transient)
      return { "P" };
    return accuracy_quantities(type);
  }

  bool is_open(const Scene &scene, const std::string &parameter)
  {
    if (scene.specified.count(parameter) == 0)
      return true;
    const auto value = scene.parameters->find(parameter);
    return value != scene.parameters->end() && value->second == "auto";
  }
} // namespace sprag
