// SPDX-License-Identifier: GPL-3.0-only
#include "estimate/choice.h"

#include "analysis/accuracy/slide_samples.h"
#include "analysis/stability/stability.h"
#include "base/errors.h"
#include "base/phase_timer.h"
#include "base/ranges.h"
#include "estimate/expected_cost.h"
#include "fe/mesh/lever_mesh.h"
#include "fe/statics/static_lever.h"
#include "input/read.h"
#include "levers/prepared_scene.h"
#include "report/summary_lines.h"
#include "scene/analysis_use.h"
#include "scene/contact_estimates.h"
#include "scene/held_slide.h"
#include "scene/lever_shape.h"
#include "scene/scene.h"

#include <boost/algorithm/string/join.hpp>

#include <algorithm>
#include <cmath>
#include <ostream>

namespace sprag
{
  namespace
  {
    constexpr double best_with_budget = 1e-4; ///< that a budget alone is spent on
    constexpr double worst            = 0.5;
    constexpr double relaxation       = 1.4; ///< of the target from try to try

    /// Relaxes the target in steps, by bisection, until what is left of the budget since a CPU time pays the choice.
    Choice cheap_enough(const Scene &scene, const double since, const ChooseToMeet &meeting)
    {
      const double first     = scene.accuracy.target > 0. ? scene.accuracy.target : best_with_budget;
      const auto is_afforded = [&](const Choice &choice) { return is_paid(with_budget_left(scene, since), choice); };
      const auto relaxed     = [&](const int steps) { return meeting(first * std::pow(relaxation, steps)); };
      Choice choice          = relaxed(0);
      if (is_afforded(choice))
        return choice;
      int too_dear = 0, steps = std::max(1, static_cast<int>(std::ceil(std::log(worst / first) / std::log(relaxation))));
      choice = relaxed(steps);
      if (!is_afforded(choice))
      {
        choice.limit = "Even the coarsest costs more than Accuracy/Budget.";
        return choice;
      }
      while (steps - too_dear > 1)
      {
        const int middle = (too_dear + steps) / 2;
        Choice finer     = relaxed(middle);
        if (is_afforded(finer))
        {
          choice = std::move(finer);
          steps  = middle;
        }
        else
          too_dear = middle;
      }
      choice.limit = "Accuracy/Budget pays no more.";
      return choice;
    }

    /// Chooses by trial runs in the plane. `run`: the scene that costs what Accuracy/Budget pays.
    Choice choose_in_plane(const Scene &scene, const Scene &run, const Announce &announce)
    {
      const double since     = PhaseTimer::cpu_seconds();
      const bool has_inertia = scene.analysis.type != AnalysisType::quasi_static;
      const auto meeting     = has_inertia ? choose_for_vibration(scene) : choose_without_inertia(scene, announce);
      return cheap_enough(run, since, meeting);
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

    constexpr double default_target = 0.01;
    constexpr double coarse_faces   = 1.5; ///< across the contact where P is largest: both trial runs have the same
    constexpr double most_faces     = 40.; ///< along the way of the contact
    constexpr unsigned int across   = 6;   ///< elements of a trial run
    constexpr const char *pressure  = "largest_pressure";

    /// Error of the plane model in quantities, relative to three dimensions.
    using ErrorsOfPlane = std::vector<std::pair<std::string, double>>;

    Scene with_trial_mesh(Scene scene)
    {
      const auto [from, to]       = swept_contact(scene);
      const double width          = estimated_contact_width(scene, contact_reference(scene).P);
      scene.mesh.face_size        = std::max({ scene.mesh.face_size, width / coarse_faces, (to - from) / most_faces });
      scene.mesh.faces_in_contact = 0.;
      scene.mesh.elements_across  = std::min(scene.mesh.elements_across, across);
      scene.analysis.dimension    = 3;
      return scene;
    }

    ErrorsOfPlane off_along_drive(const Scene &scene)
    {
      const Scene solid = with_trial_mesh(scene);
      const Scene plane = to_plane(solid);
      const QuasiStaticSettings settings{ scene.analysis.step, scene.analysis.minimum_step, scene.contact };
      const auto places  = drive_samples(scene.drive);
      const double start = scene.drive.at(0.).x;
      Mesh mesh;
      make_mesh(plane, mesh);
      const SolidBody body(solid, mesh);
      StaticLever<3> in_space(body, solid);
      StaticLever<2> in_plane(mesh, plane);
      const auto rows       = solve_at_samples(in_space, places, start, settings);
      const auto plane_rows = solve_at_samples(in_plane, places, start, settings);
      auto quantities       = scene.accuracy.quantities;
      if (!is_requested(scene, pressure))
        quantities.push_back(pressure); // is told, too
      return mapped(quantities,
                    [&](const auto &quantity) { return std::pair(quantity, relative_change(quantity, rows, plane_rows)); });
    }

    SlideStability find_slide(Scene scene)
    {
      scene.analysis.type  = AnalysisType::stability; // of which a whole lever is taken
      scene.analysis.model = ModelType::condensed;
      DynamicsMaker maker(true, 1);
      return check_slide(held_scene(scene), maker);
    }

    ErrorsOfPlane off_in_slide(const Scene &scene)
    {
      const Scene solid   = with_trial_mesh(scene);
      const auto in_space = find_slide(solid);
      const auto in_plane = find_slide(to_plane(solid));
      const double change = ringing_frequency(scene, in_plane) / ringing_frequency(scene, in_space) - 1.;
      ErrorsOfPlane result{ { "frequency", std::abs(change) } };
      if (scene.analysis.type == AnalysisType::stability)
        result.push_back({ "growth_rate", std::abs(in_plane.growth_rate() / in_space.growth_rate() - 1.) });
      if (!std::isfinite(result.front().second))
        throw AnalysisError("Analysis/Dimension: the slide of a probe has no vibration to choose by. Give 2 or 3 instead");
      return result;
    }

    /// Chooses two or three dimensions for Analysis/Dimension = auto by a trial run, the same coarse mesh in both: three where
    /// the plane is off by more than Accuracy/Target, or 1 %, in one of Accuracy/Quantity. Throws AnalysisError where a trial run
    /// has no equilibrium.
    ChosenSetting choose_dimension(const Scene &scene)
    {
      const double target = scene.accuracy.target > 0. ? scene.accuracy.target : default_target;
      const auto off      = scene.analysis.type == AnalysisType::quasi_static ? off_along_drive(scene) : off_in_slide(scene);
      bool suffices       = true;
      std::vector<std::string> texts;
      for (const auto &[quantity, error] : off)
      {
        // In time P rings with the slide's frequency.
        const bool asked_for = scene.analysis.type == AnalysisType::transient || is_requested(scene, quantity);
        suffices             = suffices && (!asked_for || error <= target);
        texts.push_back(percent(error) + " in " + quantity + (asked_for ? "" : " (not asked for)"));
      }
      return { "Analysis/Dimension", suffices ? "2" : "3",
               "the plane is off by " + boost::algorithm::join(texts, ", ") + " on the same coarse mesh, for " + percent(target) +
                   " asked for" };
    }
  } // namespace

  Scene with_settings(const Scene &scene, const std::vector<ChosenSetting> &settings)
  {
    return with_chosen(scene,
                       mapped(settings, [](const ChosenSetting &setting) { return setting.parameter + '=' + setting.value; }));
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
    const auto text = [](const ChosenSetting &setting) { return setting.parameter + " = " + setting.value; };
    return boost::algorithm::join(mapped(settings, text), "; ");
  }

  bool is_requested(const Scene &scene, const std::string &quantity)
  {
    return contains(scene.accuracy.quantities, quantity);
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

  double ringing_frequency(const Scene &scene, const SlideStability &slide)
  {
    if (scene.analysis.type != AnalysisType::transient)
      return slide.frequency();
    return eigenvalue_near(slide, contact_reference(scene).omega / (2. * M_PI)).imag() / (2. * M_PI);
  }

  Choice choose_settings(const Scene &scene, const Announce &announce)
  {
    const double since = PhaseTimer::cpu_seconds();
    if (!scene.accuracy.is_dimension_open && scene.analysis.dimension == 2)
      return choose_in_plane(scene, scene, announce);
    std::vector<ChosenSetting> dimension;
    if (scene.accuracy.is_dimension_open)
      dimension = { choose_dimension(scene) };
    const Scene chosen  = with_budget_left(prepared(with_settings(scene, dimension)), since);
    const bool in_space = chosen.analysis.dimension == 3;
    Choice choice;
    if (scene.accuracy.chooses_settings())
      choice = choose_in_plane(in_space ? to_plane(chosen) : chosen, chosen, announce);
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
