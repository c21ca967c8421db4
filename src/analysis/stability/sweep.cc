// SPDX-License-Identifier: GPL-3.0-only
#include "analysis/stability/sweep.h"

#include "base/errors.h"
#include "input/read.h"
#include "levers/prepared_scene.h"
#include "scene/contact_reference.h"
#include "scene/held_slide.h"
#include "scene/scene.h"

#include <cmath>

namespace sprag
{
  namespace
  {
    /// Reduced and condensed levers check a slide in milliseconds.
    unsigned int points_along(const Scene &scene)
    {
      const bool is_cheap = scene.analysis.model != ModelType::finite_element && scene.analysis.dimension == 2;
      return is_cheap ? 33 : 9;
    }

    /// Values that a verdict looks at inside each of Stability/Ranges.
    unsigned int values_inside(const Scene &scene)
    {
      return is_reduced(scene.analysis.model) ? 7 : 1;
    }

    /// Overrides of the scene's own constants, none, of all combinations of the ends of Stability/Ranges and, with `inside`, of
    /// so many values inside each range alone.
    std::vector<std::vector<std::string>> constant_sets(const Scene &scene, const unsigned int inside)
    {
      std::vector<std::vector<std::string>> result = { {} };
      const auto ranges                            = uncertain_ranges(scene).value_or(std::vector<ParameterRange>());
      for (unsigned int corner = 0; corner < 1u << ranges.size() && !ranges.empty(); ++corner)
      {
        result.emplace_back();
        for (std::size_t i = 0; i < ranges.size(); ++i)
          result.back().push_back(override_text(ranges[i].name, (corner >> i & 1u) == 0 ? ranges[i].from : ranges[i].to));
      }
      for (const auto &[name, from, to, points] : ranges)
        for (unsigned int i = 1; i <= inside; ++i)
          result.push_back({ override_text(name, from + (to - from) * i / (inside + 1.)) });
      return result;
    }

    CriticalSearch slides_along(const Scene &scene, DynamicModel &model, const SearchEffort &effort)
    {
      const bool over_stroke = looks_over_stroke(scene);
      const auto check_at    = [&](const double x)
      {
        DrivePoint drive = held_drive(scene);
        drive.x          = x;
        auto slide       = checked_slide(check_slide(model, drive, checked_modes(scene)), drive);
        if (over_stroke || !is_reduced(scene.analysis.model)) // where single modes would take long to follow
          slide.growth_rates.clear();
        return slide;
      };
      if (over_stroke)
        return search_kinds(stroke_range(scene, points_along(scene)), effort, check_at);
      const double x = held_drive(scene).x;
      return search_kinds({ "Stability/Position", x, x, 1 }, { 0., 0 }, check_at);
    }

    /// A beam in place of a meshed bar, with the contact law of its layer.
    Scene beam_instead(const Scene &scene)
    {
      const auto law = face_law(scene);
      return prepared(variant(scene, { "Analysis/Model=beam", override_text("Contact/Stiffness", law.stiffness),
                                       override_text("Contact/Exponent", law.exponent) }));
    }

    /// Values in the middle of what a beam says is narrower than the spacing of the range's points.
    std::vector<double> beam_hints(const Scene &scene, const ParameterRange &range)
    {
      if (!is_meshed(scene.analysis.model) || scene.analysis.dimension == 3 || !scene.mesh.file.empty())
        return {};
      DynamicsMaker maker;
      const auto check_at = [&](const double value)
      { return sweep(beam_instead(variant(scene, { override_text(range.name, value) })), maker).worst(); };
      ParameterRange finer = range;
      finer.points         = 2 * range.points - 1;
      const auto found     = search_kinds(finer, { 0.01, 4 }, check_at);
      std::vector<double> hints;
      for (std::size_t i = 1; i < found.changes.size(); ++i)
        if (const double low = found.changes[i - 1].value, high = found.changes[i].value;
            std::abs(high - low) < range_spacing(range))
          hints.push_back(0.5 * (low + high));
      return hints;
    }
  } // namespace

  const CheckedSlide &SweptSlides::worst(const Direction direction) const
  {
    const CheckedSlide *result = nullptr;
    for (const auto &way : ways)
    {
      if (direction != Direction::both && way.direction != direction)
        continue;
      if (!way.along.not_checked.empty())
        throw AnalysisError(way.along.reason);
      if (result == nullptr || is_worse(*way.along.worst, *result))
        result = &*way.along.worst;
    }
    return *result;
  }

  unsigned int SweptSlides::slides() const
  {
    unsigned int sum = 0;
    for (const auto &way : ways)
      sum += way.along.range.points + way.along.more_values;
    return sum;
  }

  SweptSlides sweep(const Scene &scene, DynamicsMaker &maker, const bool in_full)
  {
    constexpr unsigned int island_steps = 4;
    constexpr double tolerance          = 2e-3;
    SweptSlides result;
    for (const auto &constants : constant_sets(scene, in_full ? values_inside(scene) : 0))
    {
      Scene here          = constants.empty() ? scene : prepared(variant(scene, constants));
      const auto dynamics = maker.make(held_scene(here));
      for (const auto direction : held_directions(scene))
      {
        here.stability.direction = direction;
        SweptWay way{ direction, constants, slides_along(here, dynamics.model(), { in_full ? tolerance : 0., island_steps }) };
        if (way.along.worst)
          way.along.worst->constants = constants;
        result.ways.push_back(std::move(way));
      }
    }
    return result;
  }

  std::vector<std::string> ranges_without_effect(const Scene &scene, const SweptSlides &swept)
  {
    const auto ranges = uncertain_ranges(scene).value_or(std::vector<ParameterRange>());
    const auto n_ways = held_directions(scene).size();
    // The scene's own constants stand before those of the corners.
    const auto worst = [&](const std::size_t corner, const std::size_t way) -> const std::optional<CheckedSlide> &
    { return swept.ways[(1 + corner) * n_ways + way].along.worst; };
    std::vector<std::string> result;
    for (std::size_t i = 0; i < ranges.size(); ++i)
    {
      bool all_alike = true;
      for (std::size_t corner = 0; corner < std::size_t(1) << ranges.size(); ++corner)
        for (std::size_t way = 0; way < n_ways; ++way)
        {
          const auto &here = worst(corner, way), &other_end = worst(corner ^ std::size_t(1) << i, way);
          all_alike = all_alike && here && other_end && is_alike(*here, *other_end);
        }
      if (all_alike)
        result.push_back(ranges[i].name);
    }
    return result;
  }

  unsigned int least_slides(const Scene &scene, const bool in_full)
  {
    const auto sets = constant_sets(scene, in_full ? values_inside(scene) : 0).size();
    const auto n    = static_cast<unsigned int>(sets * held_directions(scene).size());
    return n * (looks_over_stroke(scene) ? points_along(scene) : 1);
  }

  bool changes_mesh(const Scene &scene, const ParameterRange &range)
  {
    // Values inside the range, where a scene is admissible sooner than at its ends.
    const auto at = [&](const double share)
    { return variant(scene, { override_text(range.name, range.from + share * (range.to - range.from)) }); };
    try
    {
      return !share_mesh(at(0.5), at(0.25));
    }
    catch (const InputError &)
    {
      return false;
    }
  }

  CriticalSearch critical_values(const Scene &scene, const ParameterRange &range, const double tolerance, DynamicsMaker &maker,
                                 const std::function<void()> &tried)
  {
    const auto check_at = [&](const double value)
    { return sweep(prepared(variant(scene, { override_text(range.name, value) })), maker).worst(); };
    return search_kinds(range, { tolerance, is_reduced(scene.analysis.model) ? 14u : 5u }, check_at, beam_hints(scene, range),
                        tried);
  }
} // namespace sprag
