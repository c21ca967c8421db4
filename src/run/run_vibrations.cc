// SPDX-License-Identifier: GPL-3.0-only
#include "base/errors.h"
#include "base/progress.h"
#include "base/ranges.h"
#include "base/text.h"
#include "estimate/dynamic_accuracy.h"
#include "fe/fields/mode_frames.h"
#include "input/read.h"
#include "laws/friction_law.h"
#include "levers/prepared_scene.h"
#include "model/lever/reduced_lever.h"
#include "model/structure/eigenmodes.h"
#include "program/result_writer.h"
#include "report/warnings.h"
#include "run/field_recorder.h"
#include "run/in_memory.h"
#include "run/run.h"
#include "run/vibration_report.h"
#include "scene/analysis_use.h"
#include "scene/closed_form.h"
#include "scene/contact_estimates.h"
#include "scene/held_slide.h"
#include "scene/mirrored_pair.h"
#include "scene/scene.h"

#include <algorithm>
#include <cmath>
#include <iostream>

namespace sprag
{
  namespace
  {
    /// The largest growth rate of the slides that a verdict looks at [1/s]; NaN where it is not known.
    double compute_growth(const Scene &scene, DynamicsMaker &maker)
    {
      try
      {
        return sweep(scene, maker).worst().growth_rate;
      }
      catch (const AnalysisError &)
      {
        return std::nan("");
      }
    }

    /// The scene as its worst slide has it.
    Scene slide_scene(const Scene &scene, const CheckedSlide &slide)
    {
      const std::vector<std::string> place = { override_text("Stability/Position", slide.drive.x),
                                               slide.drive.v < 0. ? "Stability/Direction=backward"
                                                                  : "Stability/Direction=forward" };
      return prepared(variant(scene, joined(slide.constants, place)));
    }

    bool limits_stability(const CriticalValue &change)
    {
      return (change.below == SlideKind::stable) != (change.above == SlideKind::stable);
    }

    /// Returns by how much the error of the growth rate moves a limit of stability: that of the slide which decides there, over
    /// its change with the parameter, a central difference.
    double limit_error(const Scene &scene, const std::string &name, const CriticalValue &limit)
    {
      constexpr double share = 0.04; // of the value to both sides
      const double distance  = share * std::abs(limit.value);
      DynamicsMaker maker;
      const auto slide_at = [&](const double value)
      { return held_scene(prepared(variant(slide_scene(scene, limit.worse), { override_text(name, value) }))); };
      const auto growth_at = [&](const double value) { return check_slide(slide_at(value), maker).growth_rate(); };
      try
      {
        const double slope  = (growth_at(limit.value + distance) - growth_at(limit.value - distance)) / (2. * distance);
        const Scene held    = slide_at(limit.value);
        const auto dynamics = maker.make(held);
        const auto found    = check_slide(dynamics.model(), held_drive(held), checked_modes(held, true));
        if (!is_meshed(scene.analysis.model))
          return found.error / std::abs(slope);
        const auto accuracy = vibration_accuracy(held, found, dynamics.meshed, maker);
        return accuracy.empty() ? std::nan("") : total_error(accuracy.front()) * std::abs(found.growth_rate() / slope);
      }
      catch (const InputError &)
      {
        return std::nan(""); // the scene does not admit a value beside the limit
      }
      catch (const AnalysisError &)
      {
        return std::nan("");
      }
    }

    std::vector<CriticalSearch> all_critical(const Scene &scene, DynamicsMaker &maker, const bool quiet, const bool with_errors)
    {
      const double tolerance = is_reduced(scene.analysis.model) ? 1e-8 : 1e-3; // of a value, over the distance searched
      const auto ranges      = critical_searches(scene).value_or(std::vector<ParameterRange>());
      const auto work        = [&](const ParameterRange &range)
      {
        const auto search = expected_work(scene, range);
        return range.name == "Stability/Position" ? search.values : search.slides;
      };
      Progress progress(std::cerr, progress_style(quiet || is_reduced(scene.analysis.model)),
                        std::max(1., sum_over(ranges, work)));
      double begun         = 0.;
      const bool has_error = is_meshed(scene.analysis.model) || scene.analysis.model == ModelType::beam;
      std::vector<CriticalSearch> result;
      for (const auto &range : ranges)
      {
        const double own = work(range); // where it takes more the bar waits for the end
        const auto tried = [&](const double slides) { progress.update(begun + std::min(slides, 0.99 * own), {}); };
        // Meshes that serve for one value alone are not worth a place in the cache.
        DynamicsMaker passing(false);
        auto &range_maker = is_meshed(scene.analysis.model) && changes_mesh(scene, range) ? passing : maker;
        result.push_back(critical_values(scene, range, tolerance, range_maker, tried));
        for (auto &change : result.back().changes)
          if (with_errors && has_error && limits_stability(change))
            change.error = limit_error(scene, range.name, change) + tolerance * std::abs(range.to - range.from);
        progress.update(begun += own, {});
      }
      return result;
    }

    /// Returns the loss factor that a dashpot of some Contact/Damping has at the frequency of a slide; NaN where it diverges.
    double dashpot_loss_factor(Scene scene, const CheckedSlide &slide, const double damping)
    {
      scene.contact.damping  = damping;
      const auto reference   = contact_reference(scene);
      const bool has_law     = is_reduced(scene.analysis.model); // the dashpot stays where it is softer under a smaller P
      const double stiffness = has_law ? std::pow(reference.P / slide.P, 1. - 1. / scene.contact.exponent) : 1.;
      const double omega     = slide.frequency == 0. ? std::nan("") : 2. * M_PI * slide.frequency;
      return omega * reference.relaxation * stiffness;
    }

    /// Finds over which Contact/Damping the verdict stays what it is, where a search from the scene's own to none and to a large
    /// one first meets another kind, or a value that cannot be checked. That damping is seldom measured, and more of it can make
    /// a slide grow as well as die out. `verdict`: that with the scene's own.
    std::vector<Entry> damping_entries(const Scene &scene, const CheckedSlide &verdict, DynamicsMaker &maker)
    {
      constexpr double largest      = 0.2;
      constexpr double accuracy     = 1e-3; ///< of an end, over the range
      constexpr unsigned int points = 4, island_steps = 5;
      const double own = scene.contact.damping;
      const double end = std::max(largest, own);
      double low = 0., high = end, growth_rate_at_none = std::nan("");
      SharedEquilibria shared;
      const auto check_at = [&](const double damping)
      {
        if (damping == own)
          return verdict;
        Scene damped           = with_condensed_lever(scene);
        damped.contact.damping = damping;
        SweepPart part;
        part.shared = &shared;
        auto slide  = sweep(damped, maker, part).worst();
        if (damping == 0.)
          growth_rate_at_none = slide.growth_rate;
        return slide;
      };
      const auto range_ends = [&](const double from, const double to)
      {
        const auto search = search_kinds({ "Contact/Damping", from, to, points }, { accuracy, island_steps }, { check_at });
        return joined(mapped(search.changes, &CriticalValue::value), search.not_checked);
      };
      if (own > 0.)
        for (const double value : range_ends(0., own))
          low = std::max(low, value);
      else
        growth_rate_at_none = verdict.growth_rate;
      if (own < end)
        for (const double value : range_ends(own, end))
          high = std::min(high, value);
      const bool is_dashpot    = scene.contact.damping_law == DampingLaw::dashpot;
      const double loss_factor = is_dashpot ? dashpot_loss_factor(scene, verdict, high) : 2. * high;
      return { { "contact_damping_limit_low", low },
               { "contact_damping_limit_high", high },
               { "contact_loss_factor_limit_low", loss_factor * low / high },
               { "contact_loss_factor_limit_high", loss_factor },
               { "growth_rate_without_contact_damping", growth_rate_at_none } };
    }

    /// Checks with a spring of stick ten times as soft as it is, and rigid. The mesh of a meshed lever has the layer's own shear:
    /// its stick is checked rigid alone. Where mu falls with speed, its memory is a tenth and ten times as long.
    /// `is_stable`: the verdict, which a soft stick may turn.
    std::vector<Entry> unmeasured_entries(const Scene &scene, const bool is_stable, DynamicsMaker &maker)
    {
      constexpr double soft = 0.1, rigid = 1e6;
      double soft_growth = std::nan(""), short_growth = std::nan(""), long_growth = std::nan("");
      const Scene varied = with_condensed_lever(scene);
      Scene changed      = varied;
      if (is_meshed(scene.analysis.model))
        changed.contact.tangential_penalty = rigid * contact_reference(scene).stiffness;
      else
      {
        const double own                     = contact_reference(scene).tangential;
        changed.contact.tangential_stiffness = soft * own;
        soft_growth                          = compute_growth(changed, maker);
        changed.contact.tangential_stiffness = rigid * own;
      }
      const double rigid_growth = compute_growth(changed, maker);
      if (falls_with_speed(step_friction(scene.friction, scene.drive.peak_speed())))
      {
        changed                        = varied;
        changed.friction.memory_length = 0.1 * scene.friction.memory_length;
        short_growth                   = compute_growth(changed, maker);
        changed.friction.memory_length = 10. * scene.friction.memory_length;
        long_growth                    = compute_growth(changed, maker);
      }
      std::vector<Entry> result = { { "growth_rate_soft_stick", soft_growth },
                                    { "growth_rate_rigid_stick", rigid_growth },
                                    { "growth_rate_short_memory", short_growth },
                                    { "growth_rate_long_memory", long_growth } };
      if (is_stable && soft_growth > 0.)
        result.push_back({ "soft_stick_turns_verdict", "unstable" });
      return result;
    }

    std::vector<Entry> meshed_entries(const Dynamics &dynamics)
    {
      if (!dynamics.lever && !dynamics.solid)
        return {};
      const auto n_dofs = dynamics.lever ? dynamics.lever->body->n_dofs() : dynamics.solid->body->n_dofs();
      return { { "degrees_of_freedom", static_cast<double>(n_dofs) },
               { "coordinates", static_cast<double>(dynamics.meshed.n_coordinates) } };
    }

    const std::string search_phase = "eigenvalues"; ///< which finds slides and their vibrations

    DevicePose slide_pose(const Scene &scene, const DynamicModel &model, const HeldSlide &slide)
    {
      Row row;
      row[Column::x] = slide.drive.x;
      model.observe(slide.motion, row);
      auto pose = to_pose(row);
      // A slide is held in the axes of the pivot frame.
      pose.support = 0.;
      pose.x       = held_drive(scene).x;
      return pose;
    }

    /// Returns the row of a slide for slide_warnings().
    Row slide_row(const Scene &scene, const DynamicModel &model, const HeldSlide &slide)
    {
      Row observed;
      model.observe(slide.motion, observed);
      Row row;
      row[Column::x]           = slide.drive.x;
      row[Column::v]           = slide.drive.v;
      row[Column::v_rel]       = sliding_speed(scene.geometry, slide.drive.x, slide.drive.v);
      row[Column::theta]       = observed[Column::theta];
      row[Column::P]           = slide.forces.P;
      row[Column::indentation] = slide.indentation;
      if (slide.second)
      {
        Row second            = row;
        second[Column::theta] = observed.lever_value(Column::theta, 1);
        second[Column::P]     = slide.second->P;
        row.add_second_lever(second);
      }
      return row;
    }

    /// The modes as fields for ParaView, mode-01.xdmf, ...
    void write_fields(const Scene &scene, const Dynamics &dynamics, const DevicePose &held, const std::vector<Eigenmode> &modes,
                      const RunOptions &options)
    {
      const bool is_meshed = dynamics.lever || dynamics.solid;
      if (!is_meshed || scene.output.fields == FieldOutput::none)
        return;
      prepare_folder(scene, options);
      const auto fields   = shown_body(scene, dynamics);
      unsigned int number = 0;
      for (const auto &mode : modes)
      {
        const auto lambda = mode.mode.eigenvalue;
        const auto shape  = dynamics.mode_shape(mode);
        DeviceMode device_mode{ lambda.imag() / (2. * M_PI), lambda.real(), {}, shape.support };
        for (unsigned int lever = 0; lever < shape.levers.size(); ++lever)
        {
          const auto part = [&](const unsigned int i)
          { return dynamics.meshed.elastic_displacement(as_motion(mode.mode, i), lever); };
          device_mode.levers.push_back({ { { part(0), part(1) } }, shape.levers[lever].rotation });
        }
        write_mode(scene, fields, held, device_mode, ++number, options.folder);
      }
    }

    RunEnd modal(const Scene &scene, DynamicsMaker &maker, const RunOptions &options)
    {
      auto &timer                = maker.timer();
      Scene undamped             = scene;
      undamped.stability.damping = false;
      undamped                   = held_scene(undamped);
      const auto friction        = scene.stability.contact == HeldContact::stuck ? ContactFriction::stuck : ContactFriction::none;
      const auto dynamics        = maker.make(undamped);
      auto &model                = dynamics.model();
      const auto slide           = timed(timer, search_phase, [&] { return model.hold(held_drive(undamped), friction); });
      if (!slide)
        throw AnalysisError("no equilibrium at x = " + mm(held_drive(undamped).x) + ". Try another Stability/Position.");
      const bool in_contact = scene.stability.contact != HeldContact::open;
      const auto found = timed(timer, search_phase, [&] { return model.vibrations(*slide, in_contact, scene.stability.modes); });
      auto modes       = reported(found, scene.stability.modes);
      if (dynamics.solid)
        find_across_shares(structure_modes(*dynamics.solid, count_levers(undamped)), modes);
      if (!options.quiet)
        print_modes(std::cout, modes);
      RunEnd result;
      result.meta = meshed_entries(dynamics);
      for (std::size_t i = 0; i < modes.size(); ++i)
        result.summary.push_back({ "frequency_" + std::to_string(i + 1), mode_frequency(modes[i]) });
      result.groups = { mode_group(modes, dynamics) };
      write_fields(scene, dynamics, slide_pose(scene, model, *slide), modes, options);
      return result;
    }

    RunEnd stability(const Scene &whole, DynamicsMaker &maker, const RunOptions &options, Warnings &warnings)
    {
      auto &timer = maker.timer();
      RunEnd result;
      SlideStability found;
      bool is_decided   = true;
      const auto swept  = timed(timer, search_phase, [&] { return sweep(whole, maker, { true }); });
      const Scene scene = slide_scene(whole, swept.worst());
      auto idle         = ranges_without_effect(whole, swept);
      {
        const Scene held   = held_scene(scene);
        auto dynamics      = maker.make(held);
        const auto checked = with_shapes(checked_modes(scene, true));
        found = timed(timer, search_phase, [&] { return check_slide(dynamics.model(), held_drive(scene), checked); });
        if (found.elements > beam_elements)
          dynamics.reduced = make_reduced_lever(held, found.elements);
        result.meta = meshed_entries(dynamics);
        auto modes  = reported(found.modes, scene.stability.modes);
        if (dynamics.solid)
          find_across_shares(structure_modes(*dynamics.solid, count_levers(held)), modes);
        result.groups = { mode_group(modes, dynamics) };
        if (found.slide)
        {
          write_fields(scene, dynamics, slide_pose(scene, dynamics.model(), *found.slide), modes, options);
          const auto row = slide_row(scene, dynamics.model(), *found.slide);
          append(warnings, slide_warnings(scene, row, found.slide->own_speed_share));
          if (found.beyond)
            append(warnings, beam_warnings(scene, mode_frequency(*found.beyond), found.beyond->mode.eigenvalue.real()));
        }
        if (options.in_memory == nullptr)
          result.accuracy = timed(timer, "accuracy", [&] { return vibration_accuracy(held, found, dynamics.meshed, maker); });
        // A slide that jams is decided without its growth rate.
        is_decided = found.is_decided() &&
                     (found.kind == SlideKind::jammed || result.accuracy.empty() || !(total_error(result.accuracy.front()) > 1.));
        result.summary = slide_entries(found, is_decided);
        if (options.verbose)
        {
          print_modes(std::cout, modes);
          print_growth(std::cout, modes);
        }
        else if (!options.quiet && found.slide)
          print_growing(std::cout, found.modes);
      }
      append(result.summary, sweep_entries(swept));
      if (found.slide && scene.stability.damping && scene.contact.damping_law == DampingLaw::loss_factor)
      {
        const double own = scene.contact.damping;
        result.summary.push_back({ "equal_dashpot", 2. * own * own / dashpot_loss_factor(scene, swept.worst(), own) });
      }
      if (found.slide && is_decided && scene.stability.damping && whole.stability.ranges == "none" &&
          options.in_memory == nullptr)
      {
        append(result.summary, timed(timer, search_phase, [&] { return damping_entries(whole, swept.worst(), maker); }));
        append(result.summary,
               timed(timer, search_phase, [&] { return unmeasured_entries(whole, found.kind == SlideKind::stable, maker); }));
      }
      if (scene.stability.roles)
        append(result.summary, role_entries(roles(with_condensed_lever(scene), found, maker)));
      if (scene.stability.critical != "none")
      {
        const auto critical = all_critical(whole, maker, options.quiet, options.in_memory == nullptr);
        append(result.summary, critical_entries(whole, critical));
        append(result.groups, critical_groups(critical));
        for (const auto &search : critical)
          if (!search.has_effect)
            idle.push_back(search.range.name);
      }
      append(warnings, without_effect(idle));
      return result;
    }
  } // namespace

  void run_vibrations(const Scene &scene, const RunOptions &options, Warnings &warnings)
  {
    const auto maker    = dynamics_maker(options);
    const bool undamped = scene.analysis.type == AnalysisType::modal;
    const auto end      = undamped ? modal(scene, *maker, options) : stability(scene, *maker, options, warnings);
    ResultWriter(scene, options, {}, &maker->timer()).finish("completed", end, warnings);
  }
} // namespace sprag
