// SPDX-License-Identifier: GPL-3.0-only
#include "run/design_checks.h"

#include "analysis/stability/stability.h"
#include "analysis/stability/sweep.h"
#include "analytic/isolation.h"
#include "base/errors.h"
#include "base/ranges.h"
#include "base/unknown.h"
#include "input/read.h"
#include "levers/prepared_scene.h"
#include "program/resources.h"
#include "report/report.h"
#include "report/warnings.h"
#include "run/run.h"
#include "scene/closed_form.h"
#include "scene/contact_estimates.h"
#include "scene/held_slide.h"
#include "scene/scene.h"

#include <boost/algorithm/string/join.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace sprag
{
  namespace
  {
    using Q = DesignQuantity;

    constexpr double infinite             = std::numeric_limits<double>::infinity();
    constexpr const char *no_unique_slide = "there is no unique slide at some x of the stroke: the lever jams";

    /// Share of the drive from its smallest x: near enough to x = 0 for the slope, and far enough for a contact.
    constexpr double share_for_slopes = 0.05;

    std::vector<double> sample_positions(const Scene &scene)
    {
      std::vector<double> places;
      const double from = scene.drive.minimum(), length = scene.drive.maximum() - from;
      for (unsigned int i = 1; i <= scene.design.positions; ++i)
        places.push_back(from + length * i / scene.design.positions);
      return places;
    }

    SlideStability slide_at(Scene scene, const double x, const Direction direction, DynamicsMaker &maker)
    {
      scene.stability.position  = x;
      scene.stability.direction = direction;
      return check_slide(scene, maker);
    }

    double compute_growth(const SlideStability &slide)
    {
      return slide.kind == SlideKind::jammed ? infinite : slide.growth_rate();
    }

    /// Returns how much the force of slides near rest grows over what that of the closed form does; it begins with 0 unless there
    /// is a preload.
    double ratio_near_rest(const Scene &scene, const Direction direction, DynamicsMaker &maker)
    {
      const double x     = scene.drive.minimum() + share_for_slopes * (scene.drive.maximum() - scene.drive.minimum());
      const double v     = scene.drive.peak_speed();
      const double speed = direction == Direction::forward ? v : -v;
      const auto near    = slide_at(scene, x, direction, maker);
      if (!near.slide || scene.spring.rest_angle == 0.)
        return near.slide ? near.slide->forces.Q / closed_form(scene, x, speed).Q : unknown;
      const auto far = slide_at(scene, 2. * x, direction, maker);
      return far.slide ? (far.slide->forces.Q - near.slide->forces.Q) /
                             (closed_form(scene, 2. * x, speed).Q - closed_form(scene, x, speed).Q)
                       : unknown;
    }

    /// Q and P of slides at sample_positions(), of one way.
    struct Slides
    {
      std::vector<double> Q, P;
      double growth_rate    = -infinite;
      double jamming_margin = 1.;
      bool all_unique       = true;
    };

    /// `growth_positions`: further x, whose forces do not count.
    Slides slides_along(const Scene &scene, const Direction direction, const std::vector<double> &growth_positions,
                        DynamicsMaker &maker)
    {
      Slides result;
      const auto look_at = [&](const double x)
      {
        auto found         = slide_at(scene, x, direction, maker);
        result.growth_rate = std::max(result.growth_rate, compute_growth(found));
        result.all_unique  = result.all_unique && found.slide && found.kind != SlideKind::jammed;
        return std::move(found.slide);
      };
      for (const double x : sample_positions(scene))
        if (const auto slide = look_at(x))
        {
          result.Q.push_back(slide->forces.Q);
          result.P.push_back(slide->forces.P);
          result.jamming_margin = std::min(result.jamming_margin, slide->margin);
        }
      for (const double x : growth_positions)
        look_at(x);
      return result;
    }

    /// Q of the closed form at the places, out and back.
    std::pair<Slides, Slides> ideal_slides(const Scene &scene, const std::vector<double> &places)
    {
      const double v = scene.drive.peak_speed();
      std::pair<Slides, Slides> result;
      for (const double x : places)
      {
        result.first.Q.push_back(closed_form(scene, x, v).Q);
        result.second.Q.push_back(closed_form(scene, x, -v).Q);
      }
      return result;
    }

    double loop_opening(const Slides &out, const Slides &back)
    {
      return std::accumulate(out.Q.begin(), out.Q.end(), 0.) - std::accumulate(back.Q.begin(), back.Q.end(), 0.);
    }

    void add_forces(const Scene &scene, const Slides &out, const Slides &back, DesignQuantities &found)
    {
      const auto places              = sample_positions(scene);
      found[Q::force_ratio]          = direction_ratio(out.Q.back(), back.Q.back());
      found[Q::largest_force]        = std::max(largest_magnitude(out.Q), largest_magnitude(back.Q));
      found[Q::largest_normal_force] = std::max(largest_magnitude(out.P), largest_magnitude(back.P));
      found[Q::largest_pressure]     = layer_pressure(scene, found[Q::largest_normal_force]);
      found[Q::jamming_margin]       = back.jamming_margin;
      // Both quantities depend on the spacing of the places: the closed form at all x is corrected by the ratio at these places.
      const auto ideal    = ideal_slides(scene, places);
      const auto whole    = lever_quantities(scene);
      found[Q::loop_area] = whole[Q::loop_area] * loop_opening(out, back) / loop_opening(ideal.first, ideal.second);
      found[Q::nonlinearity] =
          whole[Q::nonlinearity] * std::max(compute_nonlinearity(places, out.Q), compute_nonlinearity(places, back.Q)) /
          std::max(compute_nonlinearity(places, ideal.first.Q), compute_nonlinearity(places, ideal.second.Q));
    }

    /// Takes the largest of those entries that there are: a drive may go one way alone.
    void take_larger(double &value, const std::vector<Entry> &summary, const std::vector<std::string> &names)
    {
      for (const auto &entry : summary)
        if (contains(names, entry.name))
          value = std::max(value, std::abs(std::get<double>(entry.value)));
    }
  } // namespace

  double ModelCheck::worst(const Demand &demand) const
  {
    double value = found[demand.term.quantity];
    for (const auto &at : at_corners)
      value = worse(demand, value, at[demand.term.quantity]);
    return value;
  }

  double ModelCheck::violation(const std::vector<Demand> &demands) const
  {
    double largest = -infinite;
    for (const auto &demand : demands)
      if (demand.term.quantity != Q::parameter && !std::isnan(found[demand.term.quantity]))
        largest = std::max(largest, demand_violation(demand, worst(demand)));
    return largest;
  }

  const ModelCheck &nearest_check(const std::vector<ModelCheck> &checks, const std::vector<Demand> &demands)
  {
    const ModelCheck *nearest = &checks.back();
    for (const auto &check : checks)
    {
      const bool is_known = check.check_model == nearest->check_model && check.failure.empty();
      if (is_known && (!nearest->failure.empty() || check.violation(demands) < nearest->violation(demands)))
        nearest = &check;
    }
    return *nearest;
  }

  const ModelCheck *last_check(const std::vector<ModelCheck> &checks, const Proposal &lever)
  {
    const auto found = std::find_if(checks.rbegin(), checks.rend(),
                                    [&](const ModelCheck &check) { return check.lever.parameters == lever.parameters; });
    return found == checks.rend() ? nullptr : &*found;
  }

  Scene DesignChecks::make_scene(const ModelCheck &check) const
  {
    const std::vector<std::string> without_fields = { "Output/Fields=none" };
    const auto changes                            = joined(joined(check.changes, without_fields), check.corner);
    return prepared(variant(design, joined(changes, design_overrides(design, check.lever))));
  }

  ModelCheck DesignChecks::check(const CheckModel by, const Proposal &lever, const bool in_time)
  {
    ModelCheck check;
    check.check_model  = by;
    check.lever        = lever;
    const double begin = PhaseTimer::cpu_seconds();
    try
    {
      compute(check);
      for (const auto &corner : tolerance_corners(design.design))
        check_corner(overrides(design.design.toleranced, corner), check);
      if (by != CheckModel::table && check.passes(design.design.demanded))
        check_stroke(check);
      if (in_time && check.passes(design.design.demanded))
        follow_in_time(check);
    }
    catch (const AnalysisError &error)
    {
      check.failure = error.what();
    }
    catch (const InputError &error)
    {
      check.failure = error.what();
    }
    check.cpu_seconds = PhaseTimer::cpu_seconds() - begin;
    return check;
  }

  void DesignChecks::compute(ModelCheck &check)
  {
    if (check.check_model == CheckModel::table)
      check_table(check);
    else
      check_slides(check);
  }

  void DesignChecks::check_corner(const std::vector<std::string> &corner, ModelCheck &check)
  {
    if (!check.failure.empty())
      return;
    ModelCheck at = check;
    at.corner     = corner;
    compute(at);
    check.at_corners.push_back(at.found);
    if (!at.failure.empty())
      check.failure = at.failure + ", with " + boost::algorithm::join(corner, ", ");
  }

  void DesignChecks::check_table(ModelCheck &check) const
  {
    check.changes     = { "Analysis/Type=isolation", "Analysis/Model=closed form", "Isolation/Base motion=harmonic",
                          "Isolation/End=steady state" };
    const Scene scene = make_scene(check);
    IsolationFindings found;
    run_isolation(scene, found, {});
    check.found[Q::transmissibility]   = found.fundamental;
    check.found[Q::relative_amplitude] = found.relative_amplitude;
    if (!found.is_steady)
      check.failure = "the table's motion does not repeat within Isolation/Duration";
  }

  void DesignChecks::check_slides(ModelCheck &check)
  {
    check.changes     = { "Analysis/Type=stability", "Analysis/Model=" + enumerator_name(check.check_model),
                          "Stability/Position=auto", "Stability/Critical=none" };
    const Scene scene = make_scene(check);
    check.warnings    = scene_warnings(scene);
    require_memory(scene);
    auto &maker                 = *in_memory.dynamics;
    const auto out              = slides_along(scene, Direction::forward, growth_positions, maker);
    const auto back             = slides_along(scene, Direction::backward, growth_positions, maker);
    check.found[Q::growth_rate] = std::max(out.growth_rate, back.growth_rate);
    if (!out.all_unique || !back.all_unique)
    {
      check.failure = no_unique_slide;
      return;
    }
    const auto ideal      = lever_quantities(scene);
    const double forward  = ratio_near_rest(scene, Direction::forward, maker);
    const double backward = ratio_near_rest(scene, Direction::backward, maker);
    add_slopes(scene, forward * ideal[Q::forward_slope], backward * ideal[Q::backward_slope], check.found);
    add_forces(scene, out, back, check.found);
  }

  void DesignChecks::check_stroke(ModelCheck &check)
  {
    const auto corners = tolerance_corners(design.design);
    for (std::size_t corner = 0; corner <= corners.size(); ++corner)
    {
      auto at = check;
      if (corner > 0)
        at.corner = overrides(design.design.toleranced, corners[corner - 1]);
      const auto worst = sweep(make_scene(at), *in_memory.dynamics, { false, std::vector<std::string>() }).worst();
      const bool jams  = worst.kind == SlideKind::jammed;
      double &growth   = (corner > 0 ? check.at_corners[corner - 1] : check.found)[Q::growth_rate];
      if (!jams && worst.growth_rate <= growth)
        continue;
      growth = jams ? infinite : worst.growth_rate;
      growth_positions.push_back(worst.drive.x);
      if (jams)
        check.failure = no_unique_slide;
    }
  }

  void DesignChecks::follow_in_time(ModelCheck &check)
  {
    check.changes     = { "Analysis/Type=transient", "Analysis/Model=" + enumerator_name(check.check_model) };
    const Scene scene = make_scene(check);
    require_memory(scene);
    Warnings warnings;
    carry_out(scene, make_options(in_memory), warnings);
    const auto &summary = in_memory.found.summary;
    const auto slides   = check.found;
    take_larger(check.found[Q::largest_force], summary, { "peak_Q_forward", "peak_Q_backward" });
    take_larger(check.found[Q::largest_normal_force], summary, { "peak_P_forward", "peak_P_backward" });
    if (is_meshed(scene.analysis.model))
      take_larger(check.found[Q::largest_pressure], summary, { "largest_pressure" });
    for (const auto quantity : { Q::largest_force, Q::largest_normal_force, Q::largest_pressure })
      check.overshoot[quantity] = check.found[quantity] / slides[quantity];
    check.in_time = true;
  }

  double DesignChecks::beam_growth(const Scene &scene)
  {
    Scene beam          = scene;
    beam.analysis.type  = AnalysisType::stability;
    beam.analysis.model = ModelType::beam;
    auto &maker         = *in_memory.dynamics;
    try
    {
      const double forward = slides_along(beam, Direction::forward, growth_positions, maker).growth_rate;
      return std::max(forward, slides_along(beam, Direction::backward, growth_positions, maker).growth_rate);
    }
    catch (const AnalysisError &)
    {
      return infinite;
    }
  }
} // namespace sprag
