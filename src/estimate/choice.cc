// SPDX-License-Identifier: GPL-3.0-only
#include "estimate/choice.h"

#include "base/phase_timer.h"
#include "estimate/expected_cost.h"
#include "input/read.h"
#include "levers/prepared_scene.h"
#include "report/summary_lines.h"
#include "scene/scene.h"

#include <boost/algorithm/string/join.hpp>

#include <algorithm>
#include <ostream>

namespace sprag
{
  namespace
  {
    constexpr double best_with_budget = 1e-4; ///< that a budget alone is spent on
    constexpr double worst            = 0.5;
    constexpr double relaxation       = 1.4; ///< of the target from try to try

    Choice cheap_enough(const Scene &scene, const ChooseToMeet &meeting)
    {
      double target = scene.accuracy.target > 0. ? scene.accuracy.target : best_with_budget;
      Choice choice = meeting(target);
      if (is_paid(scene, choice))
        return choice;
      while (target < worst && !is_paid(scene, choice))
        choice = meeting(target *= relaxation);
      choice.limit =
          is_paid(scene, choice) ? "Accuracy/Budget pays no more." : "Even the coarsest costs more than Accuracy/Budget.";
      return choice;
    }

    Choice choose_in_plane(const Scene &scene, const Announce &announce)
    {
      const double since     = PhaseTimer::cpu_seconds();
      const bool has_inertia = scene.analysis.type != AnalysisType::quasi_static;
      const auto meeting     = has_inertia ? choose_for_vibration(scene) : choose_without_inertia(scene, announce);
      return cheap_enough(with_budget_left(scene, since), meeting);
    }

    void print_accuracy(std::ostream &stream, const Scene &scene, const Choice &choice)
    {
      stream << "Accuracy:     ";
      if (scene.accuracy.target > 0.)
        stream << percent(scene.accuracy.target) << " of ";
      stream << boost::algorithm::join(scene.accuracy.quantities, ", ");
      if (scene.accuracy.budget > 0.)
        stream << " within " << scene.accuracy.budget << " s";
      stream << " asked for, " << (choice.error > 0. ? percent(choice.error) + " expected. " : "nothing to choose. ")
             << choice.limit << '\n';
    }
  } // namespace

  Scene with_settings(const Scene &scene, const std::vector<ChosenSetting> &settings)
  {
    std::vector<std::string> overrides;
    for (const auto &setting : settings)
      overrides.push_back(setting.parameter + '=' + setting.value);
    return with_chosen(scene, overrides);
  }

  Scene with_budget_left(Scene scene, const double since)
  {
    constexpr double least = 1e-9; // 0 means without a bound
    if (scene.accuracy.budget > 0.)
      scene.accuracy.budget = std::max(least, scene.accuracy.budget - (PhaseTimer::cpu_seconds() - since));
    return scene;
  }

  bool is_paid(const Scene &scene, const Choice &choice)
  {
    const double budget = scene.accuracy.budget;
    return budget == 0. || expected_cost(with_settings(scene, choice.settings)).cpu_seconds <= budget;
  }

  std::string to_text(const std::vector<ChosenSetting> &settings)
  {
    std::string text;
    for (const auto &setting : settings)
      text += (text.empty() ? "" : "; ") + setting.parameter + " = " + setting.value;
    return text;
  }

  bool is_requested(const Scene &scene, const std::string &quantity)
  {
    const auto &requested = scene.accuracy.quantities;
    return std::find(requested.begin(), requested.end(), quantity) != requested.end();
  }

  Scene to_plane(Scene scene)
  {
    scene.analysis.dimension         = 2;
    scene.accuracy.is_dimension_open = false;
    auto &cylinder                   = scene.cylinder;
    cylinder.length = cylinder.position = cylinder.tilt = cylinder.skew = cylinder.crown_radius = cylinder.edge_radius = 0.;
    cylinder.tilt_stiffness = cylinder.skew_stiffness = std::nullopt;
    return scene;
  }

  Choice choose_settings(const Scene &scene, const Announce &announce)
  {
    if (!scene.accuracy.is_dimension_open && scene.analysis.dimension == 2)
      return choose_in_plane(scene, announce);
    std::vector<ChosenSetting> dimension;
    if (scene.accuracy.is_dimension_open)
      dimension = { choose_dimension(scene) };
    const Scene chosen  = with_settings(scene, dimension);
    const bool in_space = chosen.analysis.dimension == 3;
    Choice choice;
    if (scene.accuracy.chooses_settings())
      choice = choose_in_plane(in_space ? to_plane(chosen) : chosen, announce);
    choice.settings.insert(choice.settings.begin(), dimension.begin(), dimension.end());
    return choice;
  }

  Resolved resolved(const Scene &original, const Announce &announce)
  {
    Resolved result{ with_own_face_size(prepared(original)), std::nullopt };
    if (original.analysis.type == AnalysisType::study || !original.accuracy.leaves_open())
      return result;
    result.choice = choose_settings(result.scene, announce);
    result.scene  = with_own_face_size(prepared(with_settings(result.scene, result.choice->settings)));
    return result;
  }

  void print_choice(std::ostream &stream, const Scene &scene, const Choice &choice)
  {
    if (!scene.accuracy.chooses_settings())
      stream << "Chosen:\n";
    else
      print_accuracy(stream, scene, choice);
    for (const auto &setting : choice.settings)
      stream << "  " << setting.parameter << " = " << setting.value << ": " << setting.reason << '\n';
  }
} // namespace sprag
