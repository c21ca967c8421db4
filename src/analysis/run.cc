#include "analysis/run.h"

#include "analysis/closed_form.h"
#include "analysis/contact_law.h"
#include "analysis/jamming.h"
#include "analysis/prepared_scene.h"
#include "analysis/quasi_static.h"
#include "analysis/recorder.h"
#include "analysis/run_calibration.h"
#include "analysis/run_map.h"
#include "analysis/run_sprag_slip.h"
#include "analysis/run_stability.h"
#include "analysis/run_transient.h"
#include "analysis/slope.h"
#include "base/errors.h"
#include "fe/field_frames.h"
#include "fe/leaf_frames.h"
#include "fe/mirrored_levers.h"
#include "scene/closed_form.h"
#include "scene/mirrored_pair.h"

#include <deal.II/base/mpi.h>

#include <cmath>
#include <iomanip>
#include <iostream>
#include <optional>
#include <sstream>

namespace sprag
{
  namespace
  {
    using Timer = dealii::TimerOutput;

    void run_slope(const Scene &scene, const RunOptions &options)
    {
      Timer timer(std::cout, Timer::never, Timer::cpu_and_wall_times);
      const auto sweep = slope_sweep(scene);
      prepare_folder(options.folder);
      ResultFile file(options.folder + "/result.h5", scene.parameters_text, {}, sweep.columns);
      for (const auto &row : sweep.rows)
        file.append(row);
      const double mu                  = friction_coefficient(scene.friction, scene.drive.peak_speed()).coefficient;
      const std::vector<Entry> summary = { { "critical_inclination", critical_inclination(mu), "rad",
                                             "th0B = atan mu: steeper, the backward stroke no longer damps" },
                                           { "status", std::string("completed"), "", "how the run ended" } };
      file.finish(summary, process_entries(timer));
      if (!options.quiet)
        print_summary(std::cout, summary);
    }

    std::vector<Entry> contact_law_entries(const FittedContact &law)
    {
      return { { "stiffness", law.fit.stiffness, "N/mm^n", "Contact/Stiffness of the reduced models" },
               { "exponent", law.fit.exponent, "1", "Contact/Exponent" },
               { "largest_error", law.fit.largest_error, "1", "of P of the fitted law, relative" },
               { "rms_error", law.fit.rms_error, "1", "of P of the fitted law, relative" },
               { "largest_P", law.points.back().P, "N", "up to which the law was fitted" },
               { "status", std::string("completed"), "", "how the run ended" } };
    }

    void print_contact_law(const FittedContact &law)
    {
      std::cout << std::setprecision(6)
                << "\nLines for the parameter file:\n\nsubsection Contact\n  set Stiffness = " << law.fit.stiffness
                << "\n  set Exponent  = " << law.fit.exponent << "\nend\n";
    }

    void run_contact_law(const Scene &scene, const RunOptions &options)
    {
      Timer timer(std::cout, Timer::never, Timer::cpu_and_wall_times);
      require_writable(options.folder);
      const auto law = indent(scene);
      prepare_folder(options.folder);
      ResultFile file(options.folder + "/result.h5", scene.parameters_text, {},
                      { { "P", "N", "normal force" },
                        { "approach", "mm", "overlap of the cylinder with the undeformed lever" },
                        { "bending", "mm", "deflection of the Euler-Bernoulli lever at the contact" },
                        { "local", "mm", "approach less bending: what the contact law has to give" },
                        { "P_fitted", "N", "P of the fitted law at the local approach" } });
      for (const auto &point : law.points)
        file.append(std::vector<double>{ point.P, point.approach, point.bending, point.local(),
                                         law.fit.stiffness * std::pow(point.local(), law.fit.exponent) });
      const auto summary = contact_law_entries(law);
      file.finish(summary, process_entries(timer));
      if (!options.quiet)
      {
        print_summary(std::cout, summary);
        print_contact_law(law);
      }
    }

    /// Exit status 1 for a run that ended but is too far from the closed form.
    void check_deviation(const Scene &scene, const std::vector<Entry> &summary)
    {
      const double limit = scene.analysis.maximum_deviation;
      const double found = largest_deviation(summary);
      if (limit > 0. && !(found <= limit))
      {
        std::ostringstream message;
        message << "the deviation from the closed form, " << found << ", is larger than Analysis/Maximum deviation = " << limit
                << ". Try a finer Mesh/Face size or a stiffer lever, or admit more.";
        throw AnalysisError(message.str());
      }
    }

    /// Runs `steps`, finishes the record whatever happens and hands a failure on.
    template <typename Steps, typename Meta>
    void record_run(const Scene &scene, Recorder &recorder, const Steps &steps, const Meta &meta)
    {
      try
      {
        steps();
      }
      catch (const AnalysisError &error)
      {
        recorder.finish(error.what(), meta());
        throw;
      }
      check_deviation(scene, recorder.finish("completed", meta()));
    }

    void run_closed_form_model(const Scene &scene, const RunOptions &options)
    {
      Timer timer(std::cout, Timer::never, Timer::cpu_and_wall_times);
      Recorder recorder(scene, options.folder, options.quiet, {});
      record_run(
          scene, recorder, [&] { run_closed_form(scene, [&](const Row &row) { recorder.record(row); }); },
          [&] { return process_entries(timer); });
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

    /// Of the lever of a pair that is closer to jamming.
    JammingMargin least_margin(const Scene &scene, const bool flexible)
    {
      if (number_of_levers(scene) == 1)
        return jamming_margin(scene, flexible);
      const auto of_lever = [&](const unsigned int lever)
      {
        Scene alone = scene_of_lever(scene, lever);
        alone.pair  = {};
        return jamming_margin(alone, flexible);
      };
      const auto first  = of_lever(0);
      const auto second = of_lever(1);
      return first.margin() <= second.margin() ? first : second;
    }

    /// Before every run in which a cylinder is put somewhere, once nothing is left for which it could be refused.
    void announce_margin(const Scene &scene, const RunOptions &options)
    {
      if (options.quiet || scene.analysis.type == AnalysisType::slope)
        return;
      require_writable(options.folder);
      if (!scene.mesh.file.empty())
        validate(scene);
      if (dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) != 0)
        return;
      const ModelType model = scene.analysis.model;
      const bool rigid      = model == ModelType::closed_form || model == ModelType::rigid;
      std::cout << jamming_text(least_margin(scene, !rigid)) << '\n' << std::flush;
    }

    const LeverModel &first_lever(const LeverModel &model)
    {
      return model;
    }

    const LeverModel &first_lever(const MirroredLevers &model)
    {
      return model.lever(0);
    }

    State state_of_first(const LeverModel &, const State &state)
    {
      return state;
    }

    State state_of_first(const MirroredLevers &model, const State &state)
    {
      return model.state_of(0, state);
    }

    /// Pictures of the fields show the first lever of a pair.
    template <typename Levers>
    void drive_levers(const Scene &scene, const RunOptions &options, Timer &timer, Levers &levers)
    {
      const LeverModel &shown = first_lever(levers);
      Recorder recorder(scene, options.folder, options.quiet, levers.face_points());
      if (!options.quiet)
        print_model(scene, shown);
      auto meta = model_entries(scene, shown);
      std::optional<FieldFrames> frames;
      if (scene.output.fields != FieldOutput::none)
        frames.emplace(shown.elastic_body(), options.folder);
      std::optional<LeafFrames> leaf_frames;
      if (frames && scene.spring.type == SpringType::leaf)
        leaf_frames.emplace(scene, options.folder);

      double travelled = 0., last_frame = 0., x = scene.drive.at(0.).x, stick = 0.;
      const auto write = [&](const State &state, const Row &row)
      {
        const Timer::Scope scope(timer, "output");
        recorder.record(row);
        recorder.record(levers.face_state(state));
        travelled += std::abs(state.drive.x - x);
        x = state.drive.x;
        if (!wants_fields(scene, state.drive, travelled, last_frame))
          return;
        frames->write(shown.body_displacement(state_of_first(levers, state)), state.drive.time);
        if (leaf_frames)
          leaf_frames->write(row[Column::theta], state.drive.time);
      };
      QuasiStaticSettings settings{ scene.analysis.step, scene.analysis.minimum_step, scene.contact };
      record_run(
          scene, recorder,
          [&]
          {
            const Timer::Scope scope(timer, "steps_and_output");
            stick = run_quasi_static(levers, scene.drive, settings, write);
          },
          [&]
          {
            meta.push_back(
                { "stick_stiffness", stick, "N/mm",
                  "tangential stiffness of layer and penalty in stick at the first reversal, of both levers of a pair" });
            const auto process = process_entries(timer);
            meta.insert(meta.end(), process.begin(), process.end());
            return meta;
          });
    }

    void run_finite_element(const Scene &scene, const RunOptions &options)
    {
      Timer timer(std::cout, Timer::never, Timer::cpu_and_wall_times);
      require_writable(options.folder);
      dealii::Triangulation<2> triangulation;
      {
        const Timer::Scope scope(timer, "mesh");
        make_mesh(scene, triangulation);
      }
      std::optional<LeverModel> lever;
      std::optional<MirroredLevers> pair;
      {
        const Timer::Scope scope(timer, "model");
        if (number_of_levers(scene) == 2)
          pair.emplace(triangulation, scene);
        else
          lever.emplace(triangulation, lever_properties(scene));
      }
      if (pair)
        drive_levers(scene, options, timer, *pair);
      else
        drive_levers(scene, options, timer, *lever);
    }
  } // namespace

  void validate(const Scene &given)
  {
    const Scene scene  = prepared(given);
    const bool inertia = scene.analysis.type != AnalysisType::quasi_static;
    const bool meshed =
        scene.analysis.model == ModelType::finite_element || (inertia && scene.analysis.model == ModelType::condensed);
    if (scene.analysis.type == AnalysisType::slope || (!meshed && scene.analysis.type != AnalysisType::contact_law))
      return;
    dealii::Triangulation<2> triangulation;
    make_mesh(scene, triangulation);
  }

  void run(const Scene &given, const RunOptions &options)
  {
    const Scene scene = prepared(given);
    announce_margin(scene, options);
    switch (scene.analysis.type)
    {
    case AnalysisType::quasi_static:
      return scene.analysis.model == ModelType::closed_form ? run_closed_form_model(scene, options)
                                                            : run_finite_element(scene, options);
    case AnalysisType::slope:
      return run_slope(scene, options);
    case AnalysisType::transient:
      return run_transient_scene(scene, options);
    case AnalysisType::contact_law:
      return run_contact_law(scene, options);
    case AnalysisType::modal:
    case AnalysisType::stability:
      return run_vibrations(scene, options);
    case AnalysisType::map:
      return run_map(scene, options);
    case AnalysisType::sprag_slip:
      return run_sprag_slip(scene, options);
    case AnalysisType::calibration:
      return run_calibration(scene, options);
    }
  }
} // namespace sprag
