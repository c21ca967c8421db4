#include "scene/accuracy.h"

#include "scene/analysis_use.h"

namespace sprag
{
  std::vector<std::string> quantities_of(const AnalysisType type)
  {
    if (type == AnalysisType::quasi_static)
      return { "P", "Q", "loop_area", "largest_pressure", "contact_width" };
    if (type == AnalysisType::transient)
      return { "P", "frequency" };
    if (type == AnalysisType::stability || type == AnalysisType::sprag_slip)
      return { "growth_rate", "frequency" };
    return {};
  }

  std::vector<std::string> usual_quantities_of(const AnalysisType type)
  {
    if (type == AnalysisType::quasi_static)
      return { "P", "Q", "loop_area" };
    if (type == AnalysisType::transient)
      return { "P" };
    return quantities_of(type);
  }

  bool is_open(const Scene &scene, const std::string &parameter)
  {
    if (scene.given.count(parameter) == 0)
      return true;
    const auto value = scene.parameters->find(parameter);
    return value != scene.parameters->end() && value->second == "auto";
  }
} // namespace sprag
