// SPDX-License-Identifier: GPL-3.0-only
#include "estimate/expected_cost.h"

#include "analysis/stability/sweep.h"
#include "analysis/statics/quasi_static.h"
#include "analysis/study/study_points.h"
#include "analysis/transient/transient.h"
#include "base/errors.h"
#include "base/ranges.h"
#include "input/read.h"
#include "program/recorder.h"
#include "program/resources.h"
#include "scene/analysis_use.h"
#include "scene/contact_estimates.h"
#include "scene/held_slide.h"
#include "scene/mirrored_pair.h"
#include "scene/scene.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>

namespace sprag
{
  namespace
  {
    // CPU times are those measured where slowness() = 1 [s].
    constexpr double start                     = 0.2;
    constexpr double study_row                 = 1.5e-3; ///< reading its scene
    constexpr double static_step_iterations    = 9.;     ///< Newton iterations
    constexpr double transient_step_iterations = 2.5;    ///< Newton iterations
    constexpr double reversal_steps            = 20.;    ///< without inertia, through stick
    constexpr double usual_tolerance           = 5e-3;   ///< Time/Tolerance at which meshed levers take twice a beam's steps
    constexpr double table_steps               = 6000.;  ///< of levers under a table in a second of motion at that tolerance
    constexpr double elastic_cylinder          = 2.;     ///< a step with one over a step without
    constexpr double second_lever              = 2.2;    ///< the same

    double parts(const Scene &scene)
    {
      return (scene.cylinder.type == CylinderType::rigid ? 1. : elastic_cylinder) *
             (count_levers(scene) == 2 && scene.pair.type == PairType::full ? second_lever : 1.);
    }

    /// Steps that a run took; none before it.
    using StepsTaken = std::optional<double>;

    double static_steps(const Scene &scene, const StepsTaken &taken)
    {
      const double turns = 1. + static_cast<double>(scene.drive.reversals().size());
      return taken.value_or(expected_rows(scene) + reversal_steps * (0.9 + 0.1 / stick_step_share(scene.analysis.step)) * turns);
    }

    /// CPU times that a run takes once and for each of its steps or slides, where slowness() = 1 [s].
    struct Times
    {
      double once, each;
    };

    constexpr double without_errors = 0.6; ///< of what a run without inertia takes once, over all of it

    /// Without inertia. What a run takes once are model, stresses and told errors, in space the basis of the face and its checks.
    Times times_without_inertia(const Scene &scene)
    {
      const double N     = expected_size(scene).displacements;
      const double share = scene.output.errors ? 1. : without_errors;
      if (scene.analysis.dimension == 3)
        return { share * 2.8e-7 * std::pow(N, 1.45),
                 is_factorised_once(scene) ? 1.05e-9 * std::pow(N, 1.4) : 4e-6 * std::pow(N, 1.1) };
      return { share * 1.35e-5 * N, is_factorised_once(scene) ? 1.3e-3 + 3.5e-10 * std::pow(N, 1.45) : 2.3e-5 * N };
    }

    /// CPU time of the basis over that with 20 modes: factors and static shapes take as long as two modes.
    double basis_share(const Scene &scene)
    {
      const bool is_condensed = scene.analysis.model == ModelType::condensed && scene.analysis.dimension == 2;
      return is_condensed ? (2. + scene.condensed.modes) / 22. : 1.;
    }

    /// In time, or of both levers under a table. What a run takes once are the basis and, in time, fields.
    Times times_with_inertia(const Scene &scene)
    {
      const bool is_table             = scene.analysis.type == AnalysisType::isolation;
      const auto [N, n_face_unknowns] = expected_size(scene);
      if (scene.analysis.dimension == 3)
        return { 6.5e-7 * std::pow(N, 1.45), (is_table ? 0.2 : 1.) * 1.1e-8 * std::pow(n_face_unknowns, 1.55) };
      if (!is_meshed(scene.analysis.model))
        return { 0., 2e-5 };
      const double once  = basis_share(scene) * 5.5e-7 * std::pow(N, 1.5) + (is_table ? 0. : 1.2e-5 * N);
      const double faces = estimated_contact_width(scene, contact_reference(scene).P) / scene.mesh.face_size;
      if (scene.analysis.model == ModelType::condensed)
        return { once, is_table ? 5e-5 + 5e-7 * faces * faces : 2.5e-4 + 7.5e-6 * faces * faces };
      return { once, (is_table ? 2. : 1.) * 4.5e-7 * N };
    }

    /// CPU times of held slides [s]: once for the basis (in three dimensions modes and one slide) and fields, and each for a
    /// slide.
    Times slide_times(const Scene &scene)
    {
      const double N        = expected_size(scene).displacements;
      const bool has_fields = scene.output.fields != FieldOutput::none;
      const bool is_dashpot = scene.contact.damping_law == DampingLaw::dashpot;
      const double solves   = is_dashpot ? 1. : std::max(1., 0.8 * scene.stability.modes); // each vibration has its own
      if (scene.analysis.dimension == 3)
        return { 6.5e-7 * std::pow(N, 1.45) + (has_fields ? 1.4e-5 * N : 0.), 0.03 * solves };
      if (!is_meshed(scene.analysis.model))
        return { 0., 2.5e-4 * solves };
      const bool is_condensed = scene.analysis.model == ModelType::condensed;
      const double basis      = !is_condensed ? 8.25e-7 : scene.analysis.type == AnalysisType::modal ? 2.2e-7 : 4.4e-7;
      return { basis_share(scene) * basis * std::pow(N, 1.5) + (has_fields ? 1.2 : 0.),
               (is_condensed ? 0.006 : 6e-5 * N) * solves };
    }

    /// Steps that a beam takes. Finite elements need up to twice as many, as the ripple of passing elements shortens large
    /// steps.
    double steps_in_time(const Scene &scene)
    {
      constexpr double most_steps = 2e5; // that are taken by a beam to count them
      const bool is_counted       = scene.time.tolerance > 0. && expected_rows(scene) <= most_steps;
      const double steps = is_counted ? static_cast<double>(beam_run(scene).size()) : scene.drive.duration() / scene.time.step;
      const bool ripples = is_meshed(scene.analysis.model) && scene.analysis.dimension == 2;
      return steps * (ripples ? 1. + std::min(1., scene.time.tolerance / usual_tolerance) : 1.);
    }

    double count_table_steps(const Scene &scene)
    {
      const double tolerance = scene.time.tolerance;
      return scene.isolation.duration *
             (tolerance > 0. ? table_steps * std::pow(usual_tolerance / tolerance, 0.45) : 1. / scene.time.step);
    }

    /// Slides and, of meshed levers, meshes that an analysis of held ones takes.
    struct HeldWork
    {
      double slides = 1., meshes = 1.;
    };

    /// A run of a study leaves out for which damping and stick its verdict holds.
    HeldWork held_work(const Scene &scene, const bool in_study)
    {
      HeldWork work;
      if (scene.analysis.type != AnalysisType::stability)
        return work;
      constexpr double damping_values = 3., stick_limits = 2.; // dampings share equilibria
      const double verdict = least_slides(scene);
      work.slides          = verdict;
      if (scene.stability.ranges == "none" && scene.stability.damping && !in_study)
        work.slides += (damping_values + stick_limits) * verdict;
      if (scene.stability.roles)
        work.slides += 6.;
      for (const auto &range : critical_searches(scene).value_or(std::vector<ParameterRange>()))
      {
        const auto search = expected_work(scene, range);
        work.slides += range.name == "Stability/Position" ? search.values : search.slides;
        if (is_meshed(scene.analysis.model) && changes_mesh(scene, range))
          work.meshes += search.values;
      }
      return work;
    }

    /// Returns a map's scene, held at one place where it varies that.
    Scene held_in_cell(Scene scene)
    {
      for (const auto *range : { &scene.map.first, &scene.map.second })
        if (range->name == "Stability/Position")
          scene.stability.position = range->to;
      return scene;
    }

    /// CPU time of the basis of a further mesh, without errors and fields [s].
    double mesh_seconds(const Scene &scene)
    {
      return basis_share(scene) * 2.2e-7 * std::pow(expected_size(scene).displacements, 1.5);
    }

    double count_map_meshes(const Scene &scene)
    {
      double meshes = 1.;
      for (const auto *range : { &scene.map.first, &scene.map.second })
        if (changes_mesh(scene, *range))
          meshes *= range->points;
      return is_meshed(scene.analysis.model) ? meshes : 0.;
    }

    double estimate_seconds(const Scene &scene, const bool in_study, const StepsTaken &taken = {})
    {
      const auto sum = [&](const Times &times, const double number)
      { return start + times.once + number * times.each * parts(scene); };
      switch (scene.analysis.type)
      {
      case AnalysisType::quasi_static:
        return sum(times_without_inertia(scene), static_steps(scene, taken));
      case AnalysisType::transient:
        return sum(times_with_inertia(scene), taken ? *taken : steps_in_time(scene));
      case AnalysisType::isolation:
        return sum(times_with_inertia(scene), count_table_steps(scene));
      case AnalysisType::modal:
      case AnalysisType::stability:
      {
        const auto times = slide_times(scene);
        const auto work  = held_work(scene, in_study);
        // Neither errors nor fields come from further meshes.
        return sum({ times.once + (work.meshes - 1.) * mesh_seconds(scene), times.each }, work.slides);
      }
      case AnalysisType::map: // both ways, in models that are kept from cell to cell
      {
        const double each = 0.7 * slide_times(scene).each * std::max(2., searched_slides(held_in_cell(scene)));
        return sum({ count_map_meshes(scene) * mesh_seconds(scene), each }, scene.map.first.points * scene.map.second.points);
      }
      default:
        return std::numeric_limits<double>::quiet_NaN();
      }
    }

    ExpectedCost run_cost(const Scene &scene, const bool in_study)
    {
      if (follows_formulas(scene))
        return formula_cost(scene);
      ExpectedCost cost{ 0., expected_memory(scene), {} };
      if (needs_mesh(scene) && !scene.mesh.file.empty())
        cost.unknown = "the mesh is from a file.";
      try
      {
        cost.cpu_seconds = slowness() * estimate_seconds(scene, in_study);
      }
      catch (const AnalysisError &error)
      {
        cost.unknown = error.what();
      }
      if (std::isnan(cost.cpu_seconds) && cost.unknown.empty())
        cost.unknown = "it depends on what the run finds.";
      return cost;
    }

    void add_run(const std::function<Scene()> &make_run_scene, ExpectedCost &sum)
    {
      try
      {
        const Scene scene      = make_run_scene();
        const auto run         = run_cost(scene, true);
        const double own_start = follows_formulas(scene) ? formula_start_seconds : start;
        sum.cpu_seconds += run.cpu_seconds + slowness() * (study_row - own_start);
        sum.bytes   = std::max(sum.bytes, run.bytes);
        sum.unknown = sum.unknown.empty() ? run.unknown : sum.unknown;
      }
      catch (const InputError &)
      {
        return; // a row that says so
      }
    }

    constexpr std::size_t most_estimates = 100; ///< of a study's runs; they stand for the others

    ExpectedCost expected_study_cost(const Scene &study)
    {
      const double begin = slowness() * start;
      ExpectedCost sum{ begin, 0., {} };
      const auto points        = make_study_points(study.study);
      const std::size_t stride = 1 + points.size() / most_estimates;
      for (std::size_t i = 0; i < points.size(); i += stride)
        add_run([&] { return scene_at(study, points[i]); }, sum);
      sum.cpu_seconds = begin + static_cast<double>(stride) * (sum.cpu_seconds - begin);
      if (!study.study.reference_values.empty())
        add_run([&] { return reference_scene(study); }, sum);
      return sum;
    }
  } // namespace

  ExpectedCost expected_cost(const Scene &scene)
  {
    return scene.analysis.type == AnalysisType::study ? expected_study_cost(scene) : run_cost(scene, false);
  }

  double counted_work(const Scene &scene, const std::vector<Entry> &summary)
  {
    const auto *const found = find_by(summary, &Entry::name, "iterations");
    const bool is_file      = needs_mesh(scene) && !scene.mesh.file.empty();
    if (follows_formulas(scene) || is_file)
      return std::numeric_limits<double>::quiet_NaN();
    const bool in_time = scene.analysis.type == AnalysisType::transient;
    StepsTaken taken;
    if (found != nullptr)
      taken = std::get<double>(found->value) / (in_time ? transient_step_iterations : static_step_iterations);
    return estimate_seconds(scene, true, taken);
  }
} // namespace sprag
