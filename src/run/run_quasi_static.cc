#include "analysis/statics/closed_form.h"
#include "analysis/statics/quasi_static.h"
#include "base/text.h"
#include "fe/statics/lever_model.h"
#include "run/analyses.h"
#include "run/field_recorder.h"
#include "run/in_memory.h"
#include "run/quasi_static_accuracy.h"
#include "run/recorder.h"

#include <iostream>
#include <optional>

namespace sprag
{
  namespace
  {
    using Timer = dealii::TimerOutput;

    /// Exit status 1 for a run that ended but is too far from the closed form.
    void check_deviation(const Scene &scene, const std::vector<Entry> &summary)
    {
      const double limit = scene.analysis.maximum_deviation;
      const double found = largest_deviation(summary);
      if (limit > 0. && !(found <= limit))
        throw AnalysisError("the deviation from the closed form, " + rounded_text(found) +
                            ", is larger than Analysis/Maximum deviation = " + rounded_text(limit) +
                            ". Try a finer Mesh/Face size or a stiffer lever, or admit more.");
    }

    void follow_closed_form(const Scene &scene, const RunOptions &options, Warnings &warnings)
    {
      auto timer = phase_timer();
      Recorder recorder(scene, options, timer, {});
      std::vector<Entry> summary;
      finish_in_any_case([&] { run_closed_form(scene, [&](const Row &row) { recorder.record(row); }); },
                         [&](const std::string &status) { summary = recorder.finish(status, {}, warnings); });
      check_deviation(scene, summary);
    }

    std::vector<Entry> model_entries(const Scene &scene, const LeverModel &model)
    {
      const auto &body           = model.elastic_body();
      const auto [mass, inertia] = body.mass_and_inertia(scene.lever.density);
      const auto &[normal, slip] = model.penalties();
      return { { "cells", static_cast<double>(body.dofs().get_triangulation().n_active_cells()), "1", "cells of the mesh" },
               { "degrees_of_freedom", static_cast<double>(body.n_dofs()), "1", "displacements, those of the hub included" },
               { "face_points", static_cast<double>(body.friction_face().points.size()), "1",
                 "integration points of the friction face" },
               { "face_size", scene.mesh.face_size, "mm", "element length along the friction face in use, of the built-in mesh" },
               { "penalty", normal, "N/mm^3", "normal penalty in use" },
               { "tangential_penalty", slip, "N/mm^3", "tangential penalty in use" },
               { "lever_mass", mass, "t", "mass of lever, layer and hub at the lever's density" },
               { "lever_inertia", inertia, "t mm^2", "their moment of inertia about the pivot" } };
    }

    void print_model(const Scene &scene, const LeverModel &model)
    {
      const auto &body = model.elastic_body();
      std::cout << "Finite elements: " << body.n_dofs() << " displacements of degree " << scene.mesh.degree << ", plane "
                << (scene.analysis.plane == PlaneState::stress ? "stress" : "strain") << ", "
                << (scene.lever.material == MaterialModel::linear ? "linear" : "neo-Hookean") << "; "
                << body.friction_face().points.size() << " contact points; penalty " << model.penalties().normal << " N/mm^3\n"
                << std::flush;
    }

    void drive_levers(const Scene &scene, const RunOptions &options, Timer &timer, LeverModel &levers, Warnings &warnings)
    {
      Recorder recorder(scene, options, timer, levers.face_points());
      if (!options.quiet)
        print_model(scene, levers);
      auto meta             = model_entries(scene, levers);
      const bool has_frames = scene.output.fields != FieldOutput::none;
      FieldRecorder fields(scene, levers.elastic_body(), has_frames ? std::optional(options.folder) : std::nullopt, timer);

      const auto write = [&](const State &state, const Row &row)
      {
        const Timer::Scope scope(timer, "output");
        const auto face = levers.face_state(state);
        recorder.record(row);
        recorder.record(face);
        fields.record(row, face, [&] { return [&levers, state] { return levers.body_displacements(state); }; });
      };
      const QuasiStaticSettings settings{ scene.analysis.step, scene.analysis.minimum_step, scene.contact };
      double stick = 0.;
      std::vector<Entry> summary;
      finish_in_any_case(
          [&]
          {
            const Timer::Scope scope(timer, "steps_and_output");
            stick = run_quasi_static(levers, scene.drive, settings, write);
          },
          [&](const std::string &status)
          {
            recorder.set_stress(fields.finish());
            if (status == "completed" && estimates_errors(options))
            {
              const Timer::Scope scope(timer, "accuracy");
              recorder.set_accuracy(quasi_static_accuracy(scene, levers, recorder.recorded(), settings));
            }
            meta.push_back(
                { "stick_stiffness", stick, "N/mm",
                  "tangential stiffness of layer and penalty in stick at the first reversal, of both levers of a pair" });
            summary = recorder.finish(status, meta, warnings);
          });
      check_deviation(scene, summary);
    }

    void follow_finite_elements(const Scene &scene, const RunOptions &options, Warnings &warnings)
    {
      auto timer = phase_timer();
      require_folder(options);
      const auto meshes = static_meshes(options);
      timer.enter_subsection("mesh");
      const Mesh &triangulation = meshes->mesh_of(scene);
      timer.leave_subsection();
      timer.enter_subsection("model");
      LeverModel levers(triangulation, scene);
      timer.leave_subsection();
      drive_levers(scene, options, timer, levers, warnings);
    }
  } // namespace

  void run_quasi_static_scene(const Scene &scene, const RunOptions &options, Warnings &warnings)
  {
    if (scene.analysis.model == ModelType::closed_form)
      follow_closed_form(scene, options, warnings);
    else
      follow_finite_elements(scene, options, warnings);
  }
} // namespace sprag
