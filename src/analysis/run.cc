#include "analysis/run.h"

#include "analysis/closed_form.h"
#include "analysis/contact_law.h"
#include "analysis/field_recorder.h"
#include "analysis/jamming.h"
#include "analysis/prepared_scene.h"
#include "analysis/quasi_static.h"
#include "analysis/recorder.h"
#include "analysis/run_calibration.h"
#include "analysis/run_map.h"
#include "analysis/run_sprag_slip.h"
#include "analysis/run_stability.h"
#include "analysis/run_transient.h"
#include "analysis/scene_warnings.h"
#include "analysis/slope.h"
#include "base/errors.h"
#include "fe/mirrored_levers.h"
#include "scene/closed_form.h"
#include "scene/mirrored_pair.h"
#include "scene/read.h"

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

    void run_slope(const Scene &scene, const RunOptions &options, const Warnings &warnings)
    {
      Timer timer(std::cout, Timer::never, Timer::cpu_and_wall_times);
      const auto sweep = slope_sweep(scene);
      prepare_folder(options.folder);
      ResultFile file(options.folder + "/result.h5", parameters_text(scene), {}, sweep.columns);
      for (const auto &row : sweep.rows)
        file.append(row);
      const double mu                  = friction_coefficient(scene.friction, scene.drive.peak_speed()).coefficient;
      const std::vector<Entry> summary = { { "critical_inclination", critical_inclination(mu), "rad",
                                             "th0B = atan mu: steeper, the backward stroke no longer damps" },
                                           { "status", std::string("completed"), "", "how the run ended" } };
      file.finish(summary, process_entries(timer), warnings);
      if (!options.quiet)
        print_summary(std::cout, summary);
    }

    std::vector<Entry> contact_law_entries(const FittedContact &law)
    {
      return { { "stiffness", law.fit.stiffness, "N/mm^n", "Contact/Stiffness of the reduced models" },
               { "exponent", law.fit.exponent, "1", "Contact/Exponent" },
               { "largest_error", law.fit.largest_error, "1", "of P of the fitted law, relative" },
               { "rms_error", law.fit.rms_error, "1", "of P of the fitted law, relative" },
               { "penalty_error", law.penalty_error(), "1",
                 "of P by the overlap that the indentation's penalty leaves, relative" },
               { "largest_P", law.points.back().P, "N", "up to which the law was fitted" },
               { "status", std::string("completed"), "", "how the run ended" } };
    }

    void print_contact_law(const FittedContact &law)
    {
      std::cout << std::setprecision(6)
                << "\nLines for the parameter file:\n\nsubsection Contact\n  set Stiffness = " << law.fit.stiffness
                << "\n  set Exponent  = " << law.fit.exponent << "\nend\n";
    }

    void run_contact_law(const Scene &scene, const RunOptions &options, const Warnings &warnings)
    {
      Timer timer(std::cout, Timer::never, Timer::cpu_and_wall_times);
      require_writable(options.folder);
      const auto law = indent(scene);
      prepare_folder(options.folder);
      ResultFile file(options.folder + "/result.h5", parameters_text(scene), {},
                      { { "P", "N", "normal force" },
                        { "approach", "mm", "overlap of the cylinder with the undeformed lever" },
                        { "bending", "mm", "deflection of the Euler-Bernoulli lever at the contact" },
                        { "local", "mm", "approach less bending: what the contact law has to give" },
                        { "P_fitted", "N", "P of the fitted law at the local approach" } });
      for (const auto &point : law.points)
        file.append(std::vector<double>{ point.P, point.approach, point.bending, point.local(),
                                         law.fit.stiffness * std::pow(point.local(), law.fit.exponent) });
      const auto summary = contact_law_entries(law);
      file.finish(summary, process_entries(timer), warnings);
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
    void record_run(const Scene &scene, Recorder &recorder, Warnings &warnings, const Steps &steps, const Meta &meta)
    {
      try
      {
        steps();
      }
      catch (const AnalysisError &error)
      {
        recorder.finish(error.what(), meta(), warnings);
        throw;
      }
      check_deviation(scene, recorder.finish("completed", meta(), warnings));
    }

    void run_closed_form_model(const Scene &scene, const RunOptions &options, Warnings &warnings)
    {
      Timer timer(std::cout, Timer::never, Timer::cpu_and_wall_times);
      Recorder recorder(scene, options.folder, options.quiet, {});
      record_run(
          scene, recorder, warnings, [&] { run_closed_form(scene, [&](const Row &row) { recorder.record(row); }); },
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

    void try_mesh(const Scene &scene)
    {
      const bool inertia = scene.analysis.type != AnalysisType::quasi_static;
      const bool meshed =
          scene.analysis.model == ModelType::finite_element || (inertia && scene.analysis.model == ModelType::condensed);
      if (scene.analysis.type == AnalysisType::slope || (!meshed && scene.analysis.type != AnalysisType::contact_law))
        return;
      dealii::Triangulation<2> triangulation;
      make_mesh(scene, triangulation);
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
        try_mesh(scene);
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

    FieldRecorder::Displacements recovery(const LeverModel &model, const State &state)
    {
      return [find = model.recovery(state)] { return std::vector<dealii::Vector<double>>{ find() }; };
    }

    FieldRecorder::Displacements recovery(const MirroredLevers &model, const State &state)
    {
      return [first  = model.lever(0).recovery(model.state_of(0, state)),
              second = model.lever(1).recovery(model.state_of(1, state))] {
        return std::vector<dealii::Vector<double>>{ first(), second() };
      };
    }

    template <typename Levers>
    void drive_levers(const Scene &scene, const RunOptions &options, Timer &timer, Levers &levers, Warnings &warnings)
    {
      const LeverModel &shown = first_lever(levers);
      Recorder recorder(scene, options.folder, options.quiet, levers.face_points());
      if (!options.quiet)
        print_model(scene, shown);
      auto meta             = model_entries(scene, shown);
      const bool has_frames = scene.output.fields != FieldOutput::none;
      FieldRecorder fields(scene, shown.elastic_body(), has_frames ? std::optional(options.folder) : std::nullopt, timer);

      double stick     = 0.;
      const auto write = [&](const State &state, const Row &row)
      {
        const Timer::Scope scope(timer, "output");
        const auto face = levers.face_state(state);
        recorder.record(row);
        recorder.record(face);
        fields.record(row, face, [&] { return recovery(levers, state); });
      };
      QuasiStaticSettings settings{ scene.analysis.step, scene.analysis.minimum_step, scene.contact };
      record_run(
          scene, recorder, warnings,
          [&]
          {
            const Timer::Scope scope(timer, "steps_and_output");
            stick = run_quasi_static(levers, scene.drive, settings, write);
          },
          [&]
          {
            recorder.set_stress(fields.finish());
            meta.push_back(
                { "stick_stiffness", stick, "N/mm",
                  "tangential stiffness of layer and penalty in stick at the first reversal, of both levers of a pair" });
            const auto process = process_entries(timer);
            meta.insert(meta.end(), process.begin(), process.end());
            return meta;
          });
    }

    void run_finite_element(const Scene &scene, const RunOptions &options, Warnings &warnings)
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
        drive_levers(scene, options, timer, *pair, warnings);
      else
        drive_levers(scene, options, timer, *lever, warnings);
    }

    void carry_out(const Scene &scene, const RunOptions &options, Warnings &warnings)
    {
      switch (scene.analysis.type)
      {
      case AnalysisType::quasi_static:
        return scene.analysis.model == ModelType::closed_form ? run_closed_form_model(scene, options, warnings)
                                                              : run_finite_element(scene, options, warnings);
      case AnalysisType::slope:
        return run_slope(scene, options, warnings);
      case AnalysisType::transient:
        return run_transient_scene(scene, options, warnings);
      case AnalysisType::contact_law:
        return run_contact_law(scene, options, warnings);
      case AnalysisType::modal:
      case AnalysisType::stability:
        return run_vibrations(scene, options, warnings);
      case AnalysisType::map:
        return run_map(scene, options, warnings);
      case AnalysisType::sprag_slip:
        return run_sprag_slip(scene, options, warnings);
      case AnalysisType::calibration:
        return run_calibration(scene, options, warnings);
      }
    }

    /// Warnings and, in the last line, their number; by the first process alone.
    void print_end(const std::string &end, const Warnings &warnings, const bool quiet)
    {
      if (!quiet && dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
        std::cout << text_of(warnings) << end << count_text(warnings) << std::endl;
    }
  } // namespace

  Warnings validate(const Scene &given)
  {
    const Scene scene = prepared(given);
    try_mesh(scene);
    return scene_warnings(scene);
  }

  void check_warnings(const Scene &scene, const Warnings &warnings)
  {
    if (scene.analysis.warnings == WarningTreatment::error && !warnings.empty())
      throw AnalysisError("Analysis/Warnings = error: " + count_text(warnings) + ". The first says: " + warnings.front().found +
                          ' ' + warnings.front().remedy);
  }

  void run(const Scene &given, const RunOptions &options)
  {
    const Scene scene = prepared(given);
    announce_margin(scene, options);
    Warnings warnings = scene_warnings(scene);
    try
    {
      carry_out(scene, options, warnings);
    }
    catch (const AnalysisError &)
    {
      print_end("failed, ", warnings, options.quiet);
      throw;
    }
    print_end("completed, ", warnings, options.quiet);
    check_warnings(scene, warnings);
  }
} // namespace sprag
