// SPDX-License-Identifier: GPL-3.0-only
#include "analysis/statics/quasi_static.h"
#include "base/ranges.h"
#include "estimate/quasi_static_accuracy.h"
#include "fe/statics/static_lever.h"
#include "model/step/state_archive.h"
#include "program/recorder.h"
#include "program/resources.h"
#include "report/report.h"
#include "run/field_recorder.h"
#include "run/in_memory.h"
#include "run/run.h"
#include "scene/scene.h"

#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>

namespace sprag
{
  namespace
  {
    constexpr unsigned int states_checked = 12; ///< of a run, for what the compliance leaves out

    template <class Lever>
    constexpr bool in_space = std::is_same_v<Lever, StaticLever<3>>;

    template <class Lever>
    std::vector<Entry> model_entries(const Scene &scene, const Lever &lever)
    {
      const auto &body           = lever.body();
      const auto [mass, inertia] = body.mass_and_inertia(scene.lever.density);
      const auto &[normal, slip] = lever.penalties();
      std::vector<Entry> result{ { "cells", static_cast<double>(body.dofs().get_triangulation().n_active_cells()) },
                                 { "degrees_of_freedom", static_cast<double>(body.n_dofs()) },
                                 { "face_points", static_cast<double>(body.friction_face().points.size()) },
                                 { "face_size", scene.mesh.face_size },
                                 { "penalty", normal },
                                 { "tangential_penalty", slip },
                                 { "lever_mass", mass },
                                 { "lever_inertia", inertia } };
      if constexpr (in_space<Lever>)
        result.push_back(
            { "bond_loads", static_cast<double>(std::get<SolidStructure>(lever.structure()).face_compliance().basis_size()) });
      return result;
    }

    template <class Lever>
    void print_model(const Scene &scene, const Lever &lever)
    {
      const char *const plane =
          scene.analysis.plane == PlaneState::stress ? ", lever in plane stress, " : ", lever in plane strain, ";
      std::cout << "Finite elements: " << lever.body().n_dofs() << " displacements of degree " << scene.mesh.degree
                << (in_space<Lever> ? " in three dimensions, " : plane)
                << (scene.lever.material == MaterialModel::linear ? "linear" : "neo-Hookean") << "; "
                << lever.body().friction_face().points.size() << " contact points; penalty " << lever.penalties().normal
                << " N/mm^3\n"
                << std::flush;
    }

    /// Some states of a run, for what the compliance of the face leaves out in them.
    struct Samples
    {
      const double interval; ///< of travel between states looked at [mm]
      double next                          = 0.;
      double travel                        = 0.;
      double last_x                        = 0.;
      std::vector<FaceSample> face_samples = {};

      void look_at(const StaticLever<3> &lever, const State &state)
      {
        travel += std::abs(state.drive.x - last_x);
        last_x = state.drive.x;
        if (travel < next || state.forces.dofs.empty())
          return;
        next = travel + interval;
        append(face_samples, std::get<SolidStructure>(lever.structure()).samples(state.coordinates, state.forces));
      }

      /// A body at finite strain, which is solved as a whole, has none, nor has one that nothing touched.
      std::vector<Entry> entries(const StaticLever<3> &lever) const
      {
        if (!std::get<SolidStructure>(lever.structure()).is_linear() || face_samples.empty())
          return {};
        const auto worst = std::get<SolidStructure>(lever.structure()).exactness(face_samples);
        return { { "compliance_error", worst.displacement }, { "compliance_work_error", worst.work } };
      }
    };

    /// Runs a lever or a pair. `make_trial_runs`(rows, settings, stresses) makes the trial runs of its accuracy.
    template <class Lever, class MakeTrialRuns>
    void drive_levers(const Scene &scene, const RunOptions &options, PhaseTimer &timer, Lever &levers,
                      const MakeTrialRuns &make_trial_runs, Warnings &warnings)
    {
      Checkpoint checkpoint(scene, options);
      Recorder recorder(scene, options, &timer, levers.face_points(), &checkpoint);
      if (!options.quiet)
        print_model(scene, levers);
      Samples samples{ path_length(scene.drive) / states_checked };
      checkpoint.add_part([&](Archive &archive) { archive(samples.next, samples.travel, samples.last_x, samples.face_samples); });
      const bool has_frames    = scene.output.fields != FieldOutput::none;
      const auto displacements = [&levers](const std::vector<FieldSource> &sources)
      { return levers.body_displacements(mapped(sources, to_static_state)); };
      std::optional<FieldRecorder> fields;
      timed(timer, "fields",
            [&]
            {
              fields.emplace(scene, BodyFields(levers.body()), displacements,
                             has_frames ? std::optional(options.folder) : std::nullopt, timer);
            });
      checkpoint.add_part([&](Archive &archive) { fields->serialise_progress(archive); });

      const auto write = [&](const State &state, const Row &row, const Evaluation &found)
      {
        const PhaseTimer::Scope scope(timer, "output");
        const auto face = levers.face_state(state, found);
        recorder.record(row);
        recorder.record(face);
        fields->record(row, face, [&] { return FieldSource{ state.coordinates, state.forces, {} }; });
        if constexpr (in_space<Lever>)
          samples.look_at(levers, state);
      };
      const auto hand_on = [&](const State &state, const Row &row, const Evaluation &found)
      { checkpoint.hand_on([&] { write(state, row, found); }); };
      const QuasiStaticSettings settings{ scene.analysis.step, scene.analysis.minimum_step, scene.contact };
      double stick = 0.;
      std::vector<Entry> summary;
      finish_in_any_case(
          [&]
          {
            const PhaseTimer::Scope scope(timer, "steps_and_output");
            stick = run_quasi_static(levers, scene.drive, settings, hand_on, &checkpoint);
          },
          [&](const std::string &status)
          {
            auto meta       = model_entries(scene, levers);
            recorder.stress = fields->finish();
            if constexpr (in_space<Lever>)
              timed(timer, "exactness", [&] { meta = joined(meta, samples.entries(levers)); });
            if (status == "completed" && estimates_errors(scene, options))
            {
              const PhaseTimer::Scope scope(timer, "accuracy");
              const auto trial_runs = [&] { return make_trial_runs(recorder.recorded(), settings, fields->stress_samples()); };
              recorder.accuracy     = quasi_static_accuracy(scene, recorder.recorded(), trial_runs);
            }
            meta.push_back({ "stick_stiffness", stick });
            summary = recorder.finish(status, meta, warnings);
          });
      check_deviation(scene, summary);
    }

    /// Makes an empty folder for factors that are kept in files and returns its path; it is removed with the last copy of the
    /// pointer. Null if factors are kept in memory.
    std::shared_ptr<const std::string> folder_for_factors(const Scene &scene, const RunOptions &options)
    {
      const auto files = factor_files(scene, options.processes, options.folder);
      if (!files)
        return nullptr;
      if (!options.quiet)
        std::cout << "Memory: " << to_text(*files) << '\n' << std::flush;
      std::filesystem::remove_all(files->folder);
      std::filesystem::create_directories(files->folder);
      const auto remove = [](const std::string *folder)
      {
        std::error_code none;
        std::filesystem::remove_all(*folder, none);
        delete folder;
      };
      return { new std::string(files->folder), remove };
    }
  } // namespace

  void run_quasi_static_scene(const Scene &scene, const RunOptions &options, Warnings &warnings)
  {
    PhaseTimer timer;
    const auto meshes = options.in_memory != nullptr ? options.in_memory->meshes : std::make_shared<StaticMeshes>();
    const Mesh *mesh  = nullptr; // in a plane
    timed(timer, "mesh", [&] { mesh = &meshes->cached_mesh(scene); });
    if (scene.analysis.dimension == 2)
    {
      std::optional<StaticLever<2>> levers;
      timed(timer, "model", [&] { levers.emplace(*mesh, scene); });
      const auto trial_runs = [&](const auto &...arguments) { return plane_trial_runs(scene, *levers, arguments...); };
      return drive_levers(scene, options, timer, *levers, trial_runs, warnings);
    }
    const auto files = options.in_memory ? nullptr : folder_for_factors(scene, options);
    std::optional<SolidBody> body;
    timed(timer, "body", [&] { body.emplace(scene, *mesh, files ? *files : ""); });
    std::optional<StaticLever<3>> levers;
    timed(timer, "model", [&] { levers.emplace(*body, scene); });
    const auto trial_runs = [&](const auto &rows, const auto &settings, const auto &)
    { return solid_trial_runs(scene, *body, *levers, rows, settings); };
    drive_levers(scene, options, timer, *levers, trial_runs, warnings);
  }
} // namespace sprag
