// SPDX-License-Identifier: GPL-3.0-only
#include "run/expected_cost.h"

#include "analysis/stability/sweep.h"
#include "analysis/study/study_points.h"
#include "base/errors.h"
#include "program/memory.h"
#include "program/recorder.h"
#include "run/beam_run.h"
#include "scene/analysis_use.h"
#include "scene/contact_reference.h"
#include "scene/contact_width.h"
#include "scene/held_slide.h"
#include "scene/mirrored_pair.h"
#include "scene/read.h"
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
    // CPU times as measured [s], N displacements, on the machine of slowness() = 1.
    constexpr double start             = 0.2;
    constexpr double model             = 5.5e-6; ///< times N
    constexpr double telling_and_peaks = 8e-6;   ///< times N, without inertia
    constexpr double static_step       = 1.3e-3;
    constexpr double static_window     = 3.5e-10; ///< a step, times N^1.45
    constexpr double general_step      = 2.3e-5;  ///< times N
    constexpr double solid_body        = 2.2e-7;  ///< times N^1.45, with the basis of its face and the checks of it
    constexpr double solid_step        = 8e-10;   ///< times N^1.4
    constexpr double solid_finite      = 4e-6;    ///< at finite strain, times N^1.1
    constexpr double solid_modes       = 6.5e-7;  ///< times N^1.45, body and held slide included
    constexpr double solid_in_time     = 1.1e-8;  ///< a step, times displacements of the face^1.55
    constexpr double fields_of_solid   = 1.4e-5;  ///< of eight modes, times N
    constexpr double reduced_step      = 2e-5;
    constexpr double basis             = 5.5e-7; ///< times N^1.5
    // Of it, what held slides need.
    constexpr double basis_of_modes        = 0.4;
    constexpr double basis_of_slide        = 0.8;
    constexpr double basis_of_meshed_slide = 1.5;
    constexpr double fields_of_modes       = 1.2;
    constexpr double fields_in_time        = 1.2e-5; ///< times N
    constexpr double condensed_step        = 2.5e-4;
    constexpr double condensed_faces       = 7.5e-6; ///< a step, times the square of the faces in contact
    constexpr double meshed_step           = 4.5e-7; ///< times N
    constexpr double reduced_slide         = 1e-3;
    constexpr double condensed_slide       = 0.03;
    constexpr double meshed_slide          = 6e-5; ///< times N

    // Levers under a table.
    constexpr double table_steps           = 6000.; ///< in a second of motion at the usual tolerance, whatever the motion
    constexpr double table_steps_exponent  = 0.45;  ///< with which they grow as the tolerance falls
    constexpr double condensed_table_step  = 5e-5;
    constexpr double condensed_table_faces = 5e-7; ///< a step, times the square of the faces in contact
    constexpr double solid_table_step      = 0.2;  ///< in three dimensions, over one of a lever in time

    // Newton iterations.
    constexpr double of_static_step  = 9.;
    constexpr double of_step_in_time = 2.5;

    constexpr double judgements_of_cell = 0.4;  ///< both ways, in models that are kept from cell to cell
    constexpr double usual_tolerance    = 5e-3; ///< Time/Tolerance at which meshed levers take twice a beam's steps
    constexpr double steps_of_reversal  = 20.;  ///< without inertia, through stick
    constexpr double elastic_cylinder   = 2.;   ///< a step with one over a step without
    constexpr double second_lever       = 2.2;  ///< the same

    double parts(const Scene &scene)
    {
      return (scene.cylinder.type == CylinderType::rigid ? 1. : elastic_cylinder) *
             (number_of_levers(scene) == 2 && scene.pair.type == PairType::full ? second_lever : 1.);
    }

    /// Steps that a run took; none before it.
    using StepsTaken = std::optional<double>;

    double static_steps(const Scene &scene, const StepsTaken &taken)
    {
      const double turns = 1. + static_cast<double>(scene.drive.reversals().size());
      return taken.value_or(expected_rows(scene) + steps_of_reversal * turns);
    }

    double without_inertia(const Scene &scene, const StepsTaken &taken)
    {
      const double N     = expected_size(scene).displacements;
      const double steps = static_steps(scene, taken);
      const bool linear  = scene.lever.material == MaterialModel::linear && scene.analysis.solution == Solution::automatic;
      const double step  = linear ? static_step + static_window * std::pow(N, 1.45) : general_step * N;
      return start + (model + telling_and_peaks) * N + steps * step * parts(scene);
    }

    double in_three_dimensions(const Scene &scene, const StepsTaken &taken)
    {
      const double N     = expected_size(scene).displacements;
      const double steps = static_steps(scene, taken);
      const double step =
          scene.lever.material == MaterialModel::linear ? solid_step * std::pow(N, 1.4) : solid_finite * std::pow(N, 1.1);
      return start + solid_body * std::pow(N, 1.45) + steps * step * parts(scene);
    }

    double steps_in_time(const Scene &scene)
    {
      constexpr double most_steps = 2e5; // that are taken by a beam to count them
      if (scene.time.tolerance == 0. || expected_rows(scene) > most_steps)
        return scene.drive.duration() / scene.time.step;
      return static_cast<double>(beam_run(scene).size());
    }

    /// Of modes, a held slide or a run in time of so many steps in three dimensions.
    double solid_with_inertia(const Scene &scene, const double steps)
    {
      const auto [N, of_face] = expected_size(scene);
      return start + solid_modes * std::pow(N, 1.45) + steps * solid_in_time * std::pow(of_face, 1.55) * parts(scene);
    }

    double in_time(const Scene &scene, const StepsTaken &known)
    {
      const double N     = expected_size(scene).displacements;
      const double steps = known ? *known : steps_in_time(scene);
      if (scene.analysis.dimension == 3)
        return solid_with_inertia(scene, steps);
      if (!is_meshed(scene.analysis.model))
        return start + steps * reduced_step * parts(scene);
      const double faces = estimated_contact_width(scene, contact_reference(scene).P) / scene.mesh.face_size;
      const double step =
          scene.analysis.model == ModelType::condensed ? condensed_step + condensed_faces * faces * faces : meshed_step * N;
      // The ripple of elements that pass shortens large steps most.
      const double taken = steps * (known ? 1. : 1. + std::min(1., scene.time.tolerance / usual_tolerance));
      return start + basis * std::pow(N, 1.5) + fields_in_time * N + taken * step * parts(scene);
    }

    double under_table(const Scene &scene)
    {
      const double N = expected_size(scene).displacements;
      const double steps =
          scene.isolation.duration * (scene.time.tolerance > 0.
                                          ? table_steps * std::pow(usual_tolerance / scene.time.tolerance, table_steps_exponent)
                                          : 1. / scene.time.step);
      if (scene.analysis.dimension == 3)
        return solid_with_inertia(scene, solid_table_step * steps);
      if (!is_meshed(scene.analysis.model))
        return start + steps * reduced_step * parts(scene);
      const double faces = estimated_contact_width(scene, contact_reference(scene).P) / scene.mesh.face_size;
      const double step  = scene.analysis.model == ModelType::condensed
                               ? condensed_table_step + condensed_table_faces * faces * faces
                               : 2. * meshed_step * N;
      return start + basis * std::pow(N, 1.5) + steps * step * parts(scene);
    }

    /// Slides and, of meshed levers, meshes that an analysis of held ones takes.
    struct HeldWork
    {
      double slides = 1., meshes = 1.;
    };

    HeldWork held_work(const Scene &scene)
    {
      HeldWork work;
      if (scene.analysis.type != AnalysisType::stability)
        return work;
      constexpr double values_of_damping = 10., limits_of_stick = 2., between = 8.; // of a critical value
      const double verdict = least_slides(scene);
      work.slides          = verdict;
      if (scene.stability.ranges == "none" && scene.stability.damping)
        work.slides += (values_of_damping + limits_of_stick) * verdict;
      if (scene.stability.roles)
        work.slides += 6.;
      for (const auto &range : critical_searches(scene).value_or(std::vector<ParameterRange>()))
      {
        const double values = range.points + between;
        work.slides += values * (range.name == "Stability/Position" ? 1. : verdict);
        if (is_meshed(scene.analysis.model) && changes_mesh(scene, range))
          work.meshes += values;
      }
      return work;
    }

    double a_slide(const Scene &scene)
    {
      switch (scene.analysis.model)
      {
      case ModelType::condensed:
        return condensed_slide * parts(scene);
      case ModelType::finite_element:
        return meshed_slide * expected_size(scene).displacements * parts(scene);
      default:
        return reduced_slide * parts(scene);
      }
    }

    double held(const Scene &scene)
    {
      const double N = expected_size(scene).displacements;
      if (scene.analysis.dimension == 3)
        return solid_with_inertia(scene, 0.) + (scene.output.fields == FieldOutput::none ? 0. : fields_of_solid * N);
      const double bases    = scene.analysis.model == ModelType::finite_element ? basis_of_meshed_slide
                              : scene.analysis.type == AnalysisType::modal      ? basis_of_modes
                                                                                : basis_of_slide;
      const double mesh     = is_meshed(scene.analysis.model) ? bases * basis * std::pow(N, 1.5) : 0.;
      const bool has_fields = is_meshed(scene.analysis.model) && scene.output.fields != FieldOutput::none;
      const auto work       = held_work(scene);
      return start + work.meshes * mesh + work.slides * a_slide(scene) + (has_fields ? fields_of_modes : 0.);
    }

    void add_run(const std::function<Scene()> &scene_of_run, ExpectedCost &sum)
    {
      try
      {
        const auto run = expected_cost(scene_of_run());
        sum.cpu_seconds += std::max(0., run.cpu_seconds - start);
        sum.bytes   = std::max(sum.bytes, run.bytes);
        sum.unknown = sum.unknown.empty() ? run.unknown : sum.unknown;
      }
      catch (const InputError &)
      {
        return; // a row that says so
      }
    }

    constexpr std::size_t most_estimates = 100; ///< of a study's runs; they stand for the others

    ExpectedCost of_study(const Scene &study)
    {
      ExpectedCost sum{ start, 0., {} };
      const auto points        = points_of(study.study);
      const std::size_t stride = 1 + points.size() / most_estimates;
      for (std::size_t i = 0; i < points.size(); i += stride)
        add_run([&] { return scene_at(study, points[i]); }, sum);
      sum.cpu_seconds = start + static_cast<double>(stride) * (sum.cpu_seconds - start);
      if (!study.study.reference_values.empty())
        add_run([&] { return scene_of_reference(study); }, sum);
      return sum;
    }

    double seconds_of(const Scene &scene, const StepsTaken &taken = {})
    {
      switch (scene.analysis.type)
      {
      case AnalysisType::quasi_static:
        return scene.analysis.dimension == 3 ? in_three_dimensions(scene, taken) : without_inertia(scene, taken);
      case AnalysisType::transient:
        return in_time(scene, taken);
      case AnalysisType::isolation:
        return under_table(scene);
      case AnalysisType::modal:
      case AnalysisType::stability:
        return held(scene);
      case AnalysisType::map:
        return start + judgements_of_cell * scene.map.first.points * scene.map.second.points *
                           std::max(1., 0.5 * least_slides(scene)) * a_slide(scene);
      default:
        return std::numeric_limits<double>::quiet_NaN();
      }
    }
  } // namespace

  ExpectedCost expected_cost(const Scene &scene)
  {
    if (follows_formulas(scene))
      return cost_of_formulas(scene);
    if (scene.analysis.type == AnalysisType::study)
      return of_study(scene);
    ExpectedCost cost{ 0., expected_memory(scene), {} };
    if (needs_mesh(scene) && !scene.mesh.file.empty())
      cost.unknown = "the mesh is from a file.";
    try
    {
      cost.cpu_seconds = slowness() * seconds_of(scene);
    }
    catch (const AnalysisError &error)
    {
      cost.unknown = error.what();
    }
    if (std::isnan(cost.cpu_seconds) && cost.unknown.empty())
      cost.unknown = "it depends on what the run finds.";
    return cost;
  }

  double counted_work(const Scene &scene, const std::vector<Entry> &summary)
  {
    const auto found =
        std::find_if(summary.begin(), summary.end(), [](const Entry &entry) { return entry.name == "iterations"; });
    const bool is_file = needs_mesh(scene) && !scene.mesh.file.empty();
    if (follows_formulas(scene) || is_file)
      return std::numeric_limits<double>::quiet_NaN();
    const bool in_time = scene.analysis.type == AnalysisType::transient;
    StepsTaken taken;
    if (found != summary.end())
      taken = std::get<double>(found->value) / (in_time ? of_step_in_time : of_static_step);
    return seconds_of(scene, taken);
  }
} // namespace sprag
