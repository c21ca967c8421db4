#include "analysis/statics/quasi_static.h"
#include "base/append.h"
#include "fe/solid/solid_lever.h"
#include "model/state_archive.h"
#include "program/memory.h"
#include "program/recorder.h"
#include "report/report.h"
#include "run/analyses.h"
#include "run/field_recorder.h"
#include "run/in_memory.h"
#include "run/quasi_static_accuracy.h"
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

    std::vector<Entry> model_entries(const Scene &scene, const SolidBody &body, const SolidLever &lever)
    {
      const auto [mass, inertia] = body.mass_and_inertia(scene.lever.density);
      const auto &[normal, slip] = lever.penalties();
      return { { "cells", static_cast<double>(body.dofs().get_triangulation().n_active_cells()), "1", "cells of the mesh" },
               { "degrees_of_freedom", static_cast<double>(body.n_dofs()), "1", "displacements, those of the hub included" },
               { "face_points", static_cast<double>(body.friction_face().points.size()), "1",
                 "integration points of the friction face" },
               { "face_size", scene.mesh.face_size, "mm",
                 "element length along the friction face in use, the longest of a Mesh/File" },
               { "bond_loads", static_cast<double>(lever.face_compliance().basis_size()), "1",
                 "loads on the bond of the layer by which the answer of the lever behind it is found" },
               { "penalty", normal, "N/mm^3", "normal penalty in use" },
               { "tangential_penalty", slip, "N/mm^3", "tangential penalty in use" },
               { "lever_mass", mass, "t", "mass of lever, layer and hub at the lever's density" },
               { "lever_inertia", inertia, "t mm^2", "their moment of inertia about the pivot" } };
    }

    void print_model(const Scene &scene, const SolidBody &body, const SolidLever &lever)
    {
      std::cout << "Finite elements: " << body.n_dofs() << " displacements of degree " << scene.mesh.degree
                << " in three dimensions, " << (scene.lever.material == MaterialModel::linear ? "linear" : "neo-Hookean") << "; "
                << body.friction_face().points.size() << " contact points; penalty " << lever.penalties().normal << " N/mm^3\n"
                << std::flush;
    }

    /// Some states of a run, for what the compliance of the face leaves out in them.
    class Samples
    {
    public:
      explicit Samples(const double path)
          : interval(path / states_checked)
      {
      }

      void look_at(const SolidLever &lever, const State &state)
      {
        travel += std::abs(state.drive.x - last_x);
        last_x = state.drive.x;
        if (travel < next || state.forces.ports.empty())
          return;
        next = travel + interval;
        append(of_face, lever.samples(state));
      }

      /// None of a body at finite strain, which is solved as a whole, nor where nothing touched.
      std::vector<Entry> entries(const SolidLever &lever) const
      {
        if (!lever.is_linear() || of_face.empty())
          return {};
        const auto worst = lever.exactness(of_face);
        return {
          { "compliance_error", worst.displacement, "1",
            "largest displacement of the face that its compliance leaves out against the whole body, over the largest one" },
          { "compliance_work_error", worst.work, "1", "and of the work of the forces on it, over that work" }
        };
      }

    private:
      friend void visit(Archive &archive, Samples &samples)
      {
        archive(samples.next, samples.travel, samples.last_x, samples.of_face);
      }

      const double interval; ///< of travel between states looked at [mm]
      double next   = 0.;
      double travel = 0.;
      double last_x = 0.;
      std::vector<FaceSample> of_face;
    };

    void drive_lever(const Scene &scene, const RunOptions &options, PhaseTimer &timer, SolidBody &body, SolidLever &lever,
                     Warnings &warnings)
    {
      Checkpoint checkpoint(scene, options);
      Recorder recorder(scene, options, timer, lever.face_points(), &checkpoint);
      if (!options.quiet)
        print_model(scene, body, lever);
      Samples samples(path_length(scene.drive));
      checkpoint.add_part([&](Archive &archive) { visit(archive, samples); });
      const bool has_frames    = scene.output.fields != FieldOutput::none;
      const auto displacements = [&lever](const FieldSource &source) {
        return lever.body_displacements({ {}, source.coordinates, {}, source.forces });
      };
      std::optional<FieldRecorder> fields;
      timed(timer, "fields",
            [&] {
              fields.emplace(scene, BodyFields(body), displacements, has_frames ? std::optional(options.folder) : std::nullopt,
                             timer);
            });
      checkpoint.add_part([&](Archive &archive) { fields->visit_progress(archive); });
      const auto write = [&](const State &state, const Row &row)
      {
        const PhaseTimer::Scope scope(timer, "output");
        const auto face = lever.face_state(state);
        recorder.record(row);
        recorder.record(face);
        fields->record(row, face, [&] { return FieldSource{ state.coordinates, state.forces, {} }; });
        samples.look_at(lever, state);
      };
      const auto hand_on = [&](const State &state, const Row &row) { checkpoint.hand_on([&] { write(state, row); }); };
      const QuasiStaticSettings settings{ scene.analysis.step, scene.analysis.minimum_step, scene.contact };
      double stick = 0.;
      std::vector<Entry> summary;
      finish_in_any_case(
          [&]
          {
            const PhaseTimer::Scope scope(timer, "steps_and_output");
            stick = run_quasi_static(lever, scene.drive, settings, hand_on, &checkpoint);
          },
          [&](const std::string &status)
          {
            auto meta = model_entries(scene, body, lever);
            recorder.set_stress(fields->finish());
            timed(timer, "exactness", [&] { meta = joined(meta, samples.entries(lever)); });
            if (status == "completed" && estimates_errors(options))
            {
              const PhaseTimer::Scope scope(timer, "accuracy");
              const auto probes = [&] { return solid_probes(scene, body, lever, recorder.recorded(), settings); };
              recorder.set_accuracy(quasi_static_accuracy(scene, recorder.recorded(), probes));
            }
            meta.push_back(
                { "stick_stiffness", stick, "N/mm", "tangential stiffness of layer and penalty in stick at the first reversal" });
            const auto ending = status_at_end(status);
            summary           = recorder.finish(ending, meta, warnings);
            if (ending != status)
              throw AnalysisError(ending);
          });
      check_deviation(scene, summary);
    }

    /// A folder that is there as long as this, with nothing of an earlier run.
    struct FolderForFactors
    {
      explicit FolderForFactors(const std::string &name)
          : folder(name)
      {
        std::filesystem::remove_all(folder);
        std::filesystem::create_directories(folder);
      }
      FolderForFactors(const FolderForFactors &)            = delete;
      FolderForFactors &operator=(const FolderForFactors &) = delete;
      ~FolderForFactors()
      {
        std::error_code none;
        std::filesystem::remove_all(folder, none);
      }

      const std::string folder;
    };

    std::unique_ptr<FolderForFactors> folder_for_factors(const Scene &scene, const RunOptions &options)
    {
      const auto files = factor_files(scene, options.processes, options.folder);
      if (!files)
        return nullptr;
      if (!options.quiet)
        std::cout << "Memory: " << text_of(*files) << '\n' << std::flush;
      return std::make_unique<FolderForFactors>(files->folder);
    }
  } // namespace

  void run_solid_scene(const Scene &scene, const RunOptions &options, Warnings &warnings)
  {
    PhaseTimer timer;
    require_folder(options);
    const auto meshes = static_meshes(options);
    const Mesh *plane = nullptr;
    timed(timer, "mesh", [&] { plane = &meshes->mesh_of(scene); });
    const auto files = options.in_memory ? nullptr : folder_for_factors(scene, options);
    std::optional<SolidBody> body;
    timed(timer, "body", [&] { body.emplace(scene, *plane, FactorSettings{ {}, files ? files->folder : "" }); });
    std::optional<SolidLever> lever;
    timed(timer, "model", [&] { lever.emplace(*body, scene); });
    drive_lever(scene, options, timer, *body, *lever, warnings);
  }
} // namespace sprag
