#include "run/run.h"

#include "analysis/stability/jamming.h"
#include "base/errors.h"
#include "fe/mesh/mesh.h"
#include "levers/prepared_scene.h"
#include "run/analyses.h"
#include "run/result_writer.h"
#include "run/study_runs.h"
#include "run/warnings.h"
#include "scene/analysis_use.h"
#include "scene/mirrored_pair.h"

#include <deal.II/base/mpi.h>

#include <iostream>
#include <map>

namespace sprag
{
  namespace
  {
    void try_mesh(const Scene &scene)
    {
      if (!needs_mesh(scene))
        return;
      Mesh triangulation;
      make_mesh(scene, triangulation);
    }

    /// The margin of the lever of a pair that is closer to jamming.
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
      if (options.quiet || scene.analysis.type == AnalysisType::slope || scene.analysis.type == AnalysisType::study)
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

    /// Warnings and, in the last line, their number; by the first process alone.
    void print_end(const std::string &end, const Warnings &warnings, const bool quiet)
    {
      if (!quiet && dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
        std::cout << text_of(warnings) << end << count_text(warnings) << std::endl;
    }
  } // namespace

  void carry_out(const Scene &scene, const RunOptions &options, Warnings &warnings)
  {
    using Run                                     = void (*)(const Scene &, const RunOptions &, Warnings &);
    static const std::map<AnalysisType, Run> runs = { { AnalysisType::quasi_static, run_quasi_static_scene },
                                                      { AnalysisType::slope, run_slope },
                                                      { AnalysisType::transient, run_transient_scene },
                                                      { AnalysisType::contact_law, run_contact_law },
                                                      { AnalysisType::modal, run_vibrations },
                                                      { AnalysisType::stability, run_vibrations },
                                                      { AnalysisType::map, run_map },
                                                      { AnalysisType::sprag_slip, run_sprag_slip },
                                                      { AnalysisType::calibration, run_calibration },
                                                      { AnalysisType::study, run_study } };
    runs.at(scene.analysis.type)(scene, options, warnings);
  }

  Warnings validate(const Scene &given)
  {
    const Scene scene = prepared(given);
    if (scene.analysis.type == AnalysisType::study)
      require_possible_runs(scene);
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
