// SPDX-License-Identifier: GPL-3.0-only
#include "run/run.h"

#include "base/errors.h"
#include "base/phase_timer.h"
#include "base/text.h"
#include "estimate/choice.h"
#include "estimate/expected_cost.h"
#include "fe/mesh/lever_mesh.h"
#include "fe/mesh/solid_file.h"
#include "levers/prepared_scene.h"
#include "program/output_folder.h"
#include "program/resources.h"
#include "report/warnings.h"
#include "run/study_runs.h"
#include "scene/analysis_use.h"
#include "scene/scene.h"

#include <deal.II/base/exceptions.h>

#include <iostream>
#include <map>
#include <ostream>
#include <sstream>

namespace sprag
{
  namespace
  {
    /// For each process. Two are as fast as one at three times as many, see tests/benchmarks/solid-cost.md.
    constexpr double least_displacements = 1e4;

    /// Prints what each of several processes does in a run whose body they share.
    void print_processes(std::ostream &stream, const Scene &scene, const unsigned int processes)
    {
      if (processes == 1 || works_in_parallel(scene.analysis.type))
        return;
      stream << "Processes:    " << processes
             << (scene.analysis.dimension == 3
                     ? ", which share stiffness, factors, solves and fields of the lever; the first alone follows the contact\n"
                     : ", of which a lever in a plane needs the first alone\n");
    }

    void try_mesh(const Scene &scene)
    {
      if (!needs_mesh(scene))
        return;
      Mesh triangulation;
      make_mesh(scene, triangulation);
      if (triangulation.n_active_cells() == 0)
        check_solid_file(scene);
    }

    /// Adds to the cost of a run what choosing its settings has taken since the process had used so much CPU time [s].
    ExpectedCost cost_with_trials(const Scene &scene, const double since)
    {
      const double spent = PhaseTimer::cpu_seconds() - since;
      auto cost          = expected_cost(scene);
      cost.cpu_seconds += spent;
      return cost;
    }

    bool print_trial(const std::string &sentence, double)
    {
      std::cout << sentence << '\n' << std::flush;
      return true;
    }

    /// Leaves out what a check of a scene should not wait for.
    bool print_short_trial(const std::string &sentence, const double seconds)
    {
      constexpr double most = 10.; // [s]
      const bool is_short   = seconds <= most;
      return print_trial(sentence + (is_short ? "" : ", solved in the run alone"), seconds) && is_short;
    }
  } // namespace

  void require_useful_processes(const Scene &scene, const unsigned int processes)
  {
    if (processes == 1 || works_in_parallel(scene.analysis.type))
      return;
    if (!shares_body(scene))
      throw InputError("only Analysis/Type = map and study, and Analysis/Dimension = 3 or auto, run in several processes: leave "
                       "out mpirun");
    const double displacements = expected_size(scene).displacements;
    if (scene.analysis.dimension == 3 && displacements > 0. && displacements < least_displacements * processes)
      throw InputError("about " + rounded_text(displacements) + " displacements are too few for " + std::to_string(processes) +
                       " processes, which need " + rounded_text(least_displacements) +
                       " each to be of any help: start fewer, or leave out mpirun");
  }

  void carry_out(const Scene &scene, const RunOptions &options, Warnings &warnings)
  {
    static const std::map<AnalysisType, Run> runs = { { AnalysisType::quasi_static, run_quasi_static_scene },
                                                      { AnalysisType::transient, run_transient_scene },
                                                      { AnalysisType::contact_law, run_contact_law },
                                                      { AnalysisType::modal, run_vibrations },
                                                      { AnalysisType::stability, run_vibrations },
                                                      { AnalysisType::map, run_map },
                                                      { AnalysisType::sprag_slip, run_sprag_slip },
                                                      { AnalysisType::calibration, run_calibration },
                                                      { AnalysisType::isolation, run_isolation_by_models },
                                                      { AnalysisType::design, run_design },
                                                      { AnalysisType::identification, run_identification },
                                                      { AnalysisType::study, run_study } };
    if (options.in_memory == nullptr && !works_in_parallel(scene.analysis.type)) // there the first rank alone checks the folder
      require_writable(options.folder);
    if (follows_formulas(scene))
      run_formulas(scene, options, warnings);
    else
      runs.at(scene.analysis.type)(scene, options, warnings);
  }

  Warnings validate(const Scene &original)
  {
    const Scene scene = with_own_face_size(prepared(original));
    if (scene.analysis.type == AnalysisType::study)
      require_possible_runs(scene);
    try_mesh(scene);
    return scene_warnings(scene);
  }

  void print_expectations(const Scene &original, const unsigned int processes, const std::string &folder)
  {
    const double since         = PhaseTimer::cpu_seconds();
    double left_out            = 0.; // CPU time of what a run solves first [s]
    const auto [scene, choice] = resolved(original,
                                          [&](const std::string &sentence, const double seconds)
                                          {
                                            const bool is_short = print_short_trial(sentence, seconds);
                                            left_out += is_short ? 0. : seconds;
                                            return is_short;
                                          });
    if (choice)
      print_choice(std::cout, original, *choice);
    auto cost = cost_with_trials(scene, since);
    cost.cpu_seconds += left_out;
    print_cost(std::cout, cost);
    print_processes(std::cout, scene, processes);
    if (const auto files = factor_files(scene, processes, folder))
      std::cout << "Memory:       " << to_text(*files) << '\n';
  }

  void run(const Scene &original, const RunOptions &options)
  {
    if (original.accuracy.leaves_open() || !original.mesh.file.empty())
      require_writable(options.folder);
    const double since         = PhaseTimer::cpu_seconds();
    const auto [scene, choice] = options.quiet ? resolved(original) : resolved(original, print_trial);
    RunOptions telling         = options;
    if (choice)
    {
      telling.chosen = to_text(choice->settings);
      if (!options.quiet)
      {
        print_choice(std::cout, original, *choice);
        print_cost(std::cout, cost_with_trials(scene, since));
      }
      require_memory(scene, options.processes, options.in_memory == nullptr ? options.folder : "");
    }
    if (!options.quiet)
      print_processes(std::cout, scene, options.processes);
    run_from_margin_to_warnings(scene, telling, carry_out);
  }

  std::string error_message(const std::exception &error)
  {
    const auto *dealii_error = dynamic_cast<const dealii::ExceptionBase *>(&error);
    if (dealii_error == nullptr)
      return error.what();
    std::ostringstream text;
    dealii_error->print_info(text);
    return single_spaced(text.str());
  }
} // namespace sprag
