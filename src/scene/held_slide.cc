// SPDX-License-Identifier: GPL-3.0-only
#include "scene/held_slide.h"

#include "base/text.h"
#include "laws/friction_law.h"
#include "scene/analysis_use.h"
#include "scene/closed_form.h"
#include "scene/lever_shape.h"
#include "scene/scene.h"

#include <boost/algorithm/string/join.hpp>

#include <algorithm>
#include <sstream>

namespace sprag
{
  namespace
  {
    /// Single slides of reduced models cost so little that islands can be looked for.
    unsigned int tried_points(const Scene &scene)
    {
      return !is_reduced(scene.analysis.model) ? 13 : looks_over_stroke(scene) ? 25 : 49;
    }

    /// Returns a range that holds the scene's own value and what is near it.
    ParameterRange range_with(const double own, const std::string &name, const double from, const double to,
                              const unsigned int points)
    {
      constexpr double beyond = 1.5;
      return { name, std::min(from, own / beyond), std::max(to, own * beyond), points };
    }

    std::vector<ParameterRange> usual_searches(const Scene &scene)
    {
      const unsigned int tried           = tried_points(scene);
      std::vector<ParameterRange> result = { range_with(scene.friction.factor, "Friction/Factor", 0., 3., tried) };
      if (!looks_over_stroke(scene))
        result.push_back(stroke_range(scene, tried));
      const bool has_speed = scene.drive.profile() != DriveProfile::table;
      if (has_speed && !std::holds_alternative<CoulombFriction>(scene.friction.law)) // else it has no effect
        result.push_back(range_with(scene.drive.peak_speed(), "Drive/Speed", 1., 800., tried));
      const double length = scene.geometry.pivot_distance;
      if (scene.analysis.model == ModelType::beam)
        result.push_back(range_with(scene.lever.depth, "Lever/Depth", 0.01 * length, 0.15 * length, tried));
      return result;
    }

    std::optional<ParameterRange> parse_range(const std::string &text)
    {
      // The name may hold blanks: the numbers are the last two words.
      auto words = split(single_spaced(text), ' ');
      if (words.size() < 3)
        return {};
      const auto take_number = [&]
      {
        const auto number = number_alone(words.back());
        words.pop_back();
        return number;
      };
      const auto to   = take_number();
      const auto from = take_number();
      if (!from || !to)
        return {};
      return ParameterRange{ boost::algorithm::join(words, " "), *from, *to };
    }

    std::optional<std::vector<ParameterRange>> listed_ranges(const std::string &text)
    {
      std::vector<ParameterRange> result;
      if (text == "none")
        return result;
      std::istringstream stream(text);
      for (std::string entry; std::getline(stream, entry, ';');)
      {
        const auto range = parse_range(entry);
        if (!range)
          return {};
        result.push_back(*range);
      }
      return result;
    }
  } // namespace

  bool looks_over_stroke(const Scene &scene)
  {
    const auto type = scene.analysis.type;
    return (type == AnalysisType::stability || type == AnalysisType::map) && !scene.stability.position;
  }

  ParameterRange stroke_range(const Scene &scene, const unsigned int points)
  {
    const double from = scene.drive.minimum(), to = scene.drive.maximum();
    return { "Stability/Position", from + 0.05 * (to - from), to, points };
  }

  std::vector<Direction> held_directions(const Scene &scene)
  {
    if (scene.stability.direction == Direction::both)
      return { Direction::forward, Direction::backward };
    return { scene.stability.direction };
  }

  DrivePoint held_drive(const Scene &scene)
  {
    const double sign = scene.stability.direction == Direction::forward ? 1. : -1.;
    return { 0., scene.stability.position.value_or(scene.drive.maximum()), sign * scene.drive.peak_speed(), 0. };
  }

  Scene held_scene(const Scene &scene)
  {
    Scene held    = scene;
    held.friction = step_friction(scene.friction, scene.drive.peak_speed());
    if (!scene.stability.damping)
    {
      held.lever.modal_damping     = 0.;
      held.lever.mass_damping      = 0.;
      held.lever.stiffness_damping = 0.;
      held.contact.damping         = 0.;
      held.support.damping         = 0.;
    }
    return held;
  }

  std::array<double, 2> contact_range(const Scene &scene)
  {
    const double margin = 0.1 * scene.geometry.cylinder_radius + 4. * scene.layer.thickness;
    const bool stays    = holds_slide(scene.analysis.type) && scene.analysis.type != AnalysisType::sprag_slip && // which wanders
                       !looks_over_stroke(scene);
    const double held_at = kinematics(scene.geometry, held_drive(scene).x).s;
    const auto swept     = stays ? std::array<double, 2>{ { held_at, held_at } } : swept_contact(scene);
    return { { swept[0] - margin, swept[1] + margin } };
  }

  std::optional<std::vector<ParameterRange>> critical_searches(const Scene &scene)
  {
    if (scene.stability.critical == "auto")
      return usual_searches(scene);
    auto result = listed_ranges(scene.stability.critical);
    if (result)
      for (auto &range : *result)
        range.points = tried_points(scene);
    return result;
  }

  std::optional<std::vector<ParameterRange>> uncertain_ranges(const Scene &scene)
  {
    return listed_ranges(scene.stability.ranges);
  }
} // namespace sprag
