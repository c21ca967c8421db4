// SPDX-License-Identifier: GPL-3.0-only
#include "scene/analysis_use.h"

#include "base/ranges.h"
#include "base/text.h"
#include "scene/scene.h"

#include <tuple>

namespace sprag
{
  bool holds_slide(const AnalysisType type)
  {
    return type == AnalysisType::modal || type == AnalysisType::stability || type == AnalysisType::map ||
           type == AnalysisType::sprag_slip;
  }

  bool runs_model(const AnalysisType type)
  {
    return holds_slide(type) || type == AnalysisType::quasi_static || type == AnalysisType::transient;
  }

  bool works_in_parallel(const AnalysisType type)
  {
    return type == AnalysisType::map || type == AnalysisType::study;
  }

  bool shares_body(const Scene &scene)
  {
    const auto type        = scene.analysis.type;
    const bool is_in_space = scene.analysis.dimension == 3 || scene.accuracy.is_dimension_open;
    return is_in_space && !works_in_parallel(type) && (runs_model(type) || isolates_by_model(scene));
  }

  bool isolates_by_model(const Scene &scene)
  {
    return scene.analysis.type == AnalysisType::isolation && scene.isolation.damper == DamperType::lever &&
           scene.analysis.model != ModelType::closed_form;
  }

  bool is_checked_by_mesh(const Scene &scene)
  {
    return scene.analysis.type == AnalysisType::design && contains(scene.design.check_models, CheckModel::condensed);
  }

  bool identifies_by_model(const Scene &scene)
  {
    return scene.analysis.type == AnalysisType::identification && scene.analysis.model != ModelType::closed_form;
  }

  bool needs_mesh(const Scene &scene)
  {
    const AnalysisType type = scene.analysis.type;
    if (runs_model(type) || isolates_by_model(scene) || identifies_by_model(scene))
      return is_meshed(scene.analysis.model);
    return type == AnalysisType::contact_law || type == AnalysisType::calibration;
  }

  bool follows_formulas(const Scene &scene)
  {
    const auto &[type, model] = std::tie(scene.analysis.type, scene.analysis.model);
    const bool is_ideal =
        type == AnalysisType::transient && model == ModelType::rigid && scene.contact.type == ContactType::ideal;
    const bool is_closed =
        (type == AnalysisType::quasi_static || type == AnalysisType::transient) && model == ModelType::closed_form;
    return type == AnalysisType::slope || (type == AnalysisType::isolation && !isolates_by_model(scene)) || is_closed || is_ideal;
  }

  bool is_factorised_once(const Scene &scene)
  {
    return scene.analysis.type == AnalysisType::quasi_static && scene.lever.material == MaterialModel::linear &&
           scene.analysis.solution == Solution::automatic;
  }

  Scene with_condensed_lever(Scene scene)
  {
    if (scene.analysis.model == ModelType::finite_element)
      scene.analysis.model = ModelType::condensed;
    return scene;
  }

  std::vector<std::string> accuracy_quantities(const AnalysisType type)
  {
    if (type == AnalysisType::quasi_static)
      return { "P", "Q", "loop_area", "largest_pressure", "contact_width", "largest_lever_stress", "largest_layer_stress" };
    if (type == AnalysisType::transient)
      return { "P", "overshoot", "frequency" };
    if (type == AnalysisType::stability || type == AnalysisType::sprag_slip)
      return { "growth_rate", "frequency" };
    return {};
  }

  std::vector<std::string> quantities_meant(const std::string &text, const AnalysisType type)
  {
    if (text != "auto")
      return split_all(text, ',');
    if (type == AnalysisType::quasi_static)
      return { "P", "Q", "loop_area" };
    if (type == AnalysisType::transient)
      return { "P" };
    return accuracy_quantities(type);
  }

  bool is_chosen(const Scene &scene, const std::string &parameter)
  {
    return scene.chosen.count(parameter) > 0;
  }

  bool is_open(const Scene &scene, const std::string &parameter)
  {
    return scene.specified.count(parameter) == 0 || scene.parameters->at(parameter) == "auto";
  }
} // namespace sprag
