#include "analysis/statics/quasi_static.h"
#include "fe/statics/lever_model.h"
#include "program/recorder.h"
#include "report/report.h"
#include "run/analyses.h"
#include "run/field_recorder.h"
#include "run/in_memory.h"
#include "run/quasi_static_accuracy.h"
#include "scene/scene.h"

#include <iostream>
#include <optional>

namespace sprag
{
  namespace
  {
    std::vector<Entry> model_entries(const Scene &scene, const LeverModel &model)
    {
      const auto &body           = model.elastic_body();
      const auto [mass, inertia] = body.mass_and_inertia(scene.lever.density);
      const auto &[normal, slip] = model.penalties();
      return { { "cells", static_cast<double>(body.dofs().get_triangulation().n_active_cells()), "1", "cells of the mesh" },
               { "degrees_of_freedom", static_cast<double>(body.n_dofs()), "1", "displacements, those of the hub included" },
               { "face_points", static_cast<double>(body.friction_face().points.size()), "1",
                 "integration points of the friction face" },
               { "face_size", scene.mesh.face_size, "mm",
                 "element length along the friction face in use, the longest of a Mesh/File" },
               { "penalty", normal, "N/mm^3", "normal penalty in use" },
               { "tangential_penalty", slip, "N/mm^3", "tangential penalty in use" },
               { "lever_mass", mass, "t", "mass of lever, layer and hub at the lever's density" },
               { "lever_inertia", inertia, "t mm^2", "their moment of inertia about the pivot" } };
    }

    void print_model(const Scene &scene, const LeverModel &model)
    {
      const auto &body = model.elastic_body();
      std::cout << "Finite elements: " << body.n_dofs() << " displacements of degree " << scene.mesh.degree << ", lever in plane "
                << (scene.analysis.plane == PlaneState::stress ? "stress" : "strain") << ", "
                << (scene.lever.material == MaterialModel::linear ? "linear" : "neo-Hookean") << "; "
                << body.friction_face().points.size() << " contact points; penalty " << model.penalties().normal << " N/mm^3\n"
                << std::flush;
    }

    void drive_levers(const Scene &scene, const RunOptions &options, PhaseTimer &timer, LeverModel &levers, Warnings &warnings)
    {
      Checkpoint checkpoint(scene, options);
      Recorder recorder(scene, options, timer, levers.face_points(), &checkpoint);
      if (!options.quiet)
        print_model(scene, levers);
      auto meta                = model_entries(scene, levers);
      const bool has_frames    = scene.output.fields != FieldOutput::none;
      const auto displacements = [&levers](const FieldSource &source) {
        return levers.body_displacements({ {}, source.coordinates, {}, source.forces });
      };
      FieldRecorder fields(scene, BodyFields(levers.elastic_body()), displacements,
                           has_frames ? std::optional(options.folder) : std::nullopt, timer);
      checkpoint.add_part([&](Archive &archive) { fields.visit_progress(archive); });

      const auto write = [&](const State &state, const Row &row)
      {
        const PhaseTimer::Scope scope(timer, "output");
        const auto face = levers.face_state(state);
        recorder.record(row);
        recorder.record(face);
        fields.record(row, face, [&] { return FieldSource{ state.coordinates, state.forces, {} }; });
      };
      const auto hand_on = [&](const State &state, const Row &row) { checkpoint.hand_on([&] { write(state, row); }); };
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
            recorder.set_stress(fields.finish());
            if (status == "completed" && estimates_errors(options))
            {
              const PhaseTimer::Scope scope(timer, "accuracy");
              const auto probes = [&]
              { return plane_probes(scene, levers, recorder.recorded(), settings, fields.stress_samples()); };
              recorder.set_accuracy(quasi_static_accuracy(scene, recorder.recorded(), probes));
            }
            meta.push_back(
                { "stick_stiffness", stick, "N/mm",
                  "tangential stiffness of layer and penalty in stick at the first reversal, of both levers of a pair" });
            const auto ending = status_at_end(status);
            summary           = recorder.finish(ending, meta, warnings);
            if (ending != status)
              throw AnalysisError(ending);
          });
      check_deviation(scene, summary);
    }
  } // namespace

  void run_quasi_static_scene(const Scene &scene, const RunOptions &options, Warnings &warnings)
  {
    if (scene.analysis.dimension == 3)
      return run_solid_scene(scene, options, warnings);
    PhaseTimer timer;
    require_folder(options);
    const auto meshes         = static_meshes(options);
    const Mesh *triangulation = nullptr;
    timed(timer, "mesh", [&] { triangulation = &meshes->mesh_of(scene); });
    std::optional<LeverModel> levers;
    timed(timer, "model", [&] { levers.emplace(*triangulation, scene); });
    drive_levers(scene, options, timer, *levers, warnings);
  }
} // namespace sprag
