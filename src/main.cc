#include "analysis/team/team.h"
#include "base/all_cores.h"
#include "base/error_text.h"
#include "base/errors.h"
#include "base/guard.h"
#include "base/hdf5_handle.h"
#include "base/interrupt.h"
#include "results/earlier_result.h"
#include "results/warning.h"
#include "run/memory.h"
#include "run/output_folder.h"
#include "run/run.h"
#include "scene/analysis_use.h"
#include "scene/read.h"

#include <cstdlib>
#include <deal.II/base/mpi.h>

#include <CLI/CLI.hpp>

#include <csignal>
#include <cstring>
#include <ctime>
#include <iostream>
#include <optional>

namespace
{
  enum ExitStatus
  {
    success         = 0,
    analysis_failed = 1,
    bad_input       = 2
  };

  struct Arguments
  {
    std::string file;
    std::vector<std::string> overrides;
    std::string folder;
    bool validate         = false;
    bool print_parameters = false;
    bool quiet            = false;
    bool overwrite        = false;
    unsigned int jobs     = 0; ///< 0: as many as cores
  };

  void declare(CLI::App &app, Arguments &arguments)
  {
    app.add_option("FILE.prm", arguments.file, "The scene: a parameter file; see params/README.md");
    app.add_option("--set", arguments.overrides, "\"Section/Name=value\": overrides a parameter of the file; may be repeated")
        ->allow_extra_args(false);
    app.add_option("--output", arguments.folder, "Folder for results; default output/NAME_OF_THE_FILE");
    app.add_flag("--overwrite", arguments.overwrite, "Replace the completed result of another scene in that folder");
    app.add_flag("--validate", arguments.validate, "Check the file and stop");
    app.add_flag("--print-parameters", arguments.print_parameters, "Print every parameter with its meaning and stop");
    app.add_flag("--quiet", arguments.quiet, "Print errors only");
    app.add_option("--jobs", arguments.jobs, "Processes that work on a map or study; default: one a core")
        ->check(CLI::PositiveNumber);
    app.set_version_flag("--version", std::string("sprag " SPRAG_VERSION));
    app.footer("Exit status: 0 success, 1 the analysis failed or was interrupted (finished steps are kept), 2 bad input (nothing "
               "is written).");
  }

  std::string folder_of(const Arguments &arguments, const sprag::Scene &scene)
  {
    return arguments.folder.empty() ? "output/" + scene.name : arguments.folder;
  }

  bool is_run(const Arguments &arguments)
  {
    return !arguments.validate && !arguments.print_parameters;
  }

  sprag::Scene scene_of(const Arguments &arguments)
  {
    if (arguments.file.empty())
      throw sprag::InputError("FILE.prm is missing; try --help");
    return sprag::read_scene(arguments.file, arguments.overrides);
  }

  void execute(const Arguments &arguments, const sprag::Scene &scene)
  {
    if (arguments.print_parameters)
    {
      std::cout << sprag::parameters_text(scene);
      return;
    }
    if (arguments.validate)
    {
      sprag::require_memory(scene);
      const auto warnings = sprag::validate(scene);
      if (!arguments.quiet)
        std::cout << sprag::text_of(warnings) << arguments.file << ": valid, " << sprag::count_text(warnings) << '\n';
      return sprag::check_warnings(scene, warnings);
    }
    const bool alone = dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) == 1;
    if (!alone && !sprag::works_in_parallel(scene.analysis.type))
      throw sprag::InputError("only Analysis/Type = map and study run in several processes: leave out mpirun");
    const std::string folder = folder_of(arguments, scene);
    sprag::on_first_rank([&] { sprag::claim_folder(folder, sprag::parameters_text(scene), arguments.overwrite); });
    const unsigned int processes = dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD);
    sprag::on_first_rank([&] { sprag::require_memory(scene, processes); });
    sprag::run(scene, { folder, arguments.quiet });
  }

  /// What a run leaves unfinished gets its end; returns whether there was anything.
  bool finish(const Arguments &arguments, const sprag::Scene &scene, const std::string &status, const std::timespec &since)
  {
    return is_run(arguments) &&
           sprag::finish_abandoned(folder_of(arguments, scene) + "/result.h5", sprag::parameters_text(scene), status, since);
  }

  int tell(const sprag::InputError &error)
  {
    std::cerr << error.what() << '\n';
    return bad_input;
  }

  int tell(const std::string &failure)
  {
    std::cerr << "sprag: " << failure << '\n';
    return analysis_failed;
  }

  /// Errors of an analysis come on all ranks alike and are told by the first; any other may be one rank's own.
  int exit_status_of(const Arguments &arguments, std::optional<sprag::Scene> scene, const std::timespec &since)
  {
    namespace MPI        = dealii::Utilities::MPI;
    const bool is_first  = MPI::this_mpi_process(MPI_COMM_WORLD) == 0;
    const bool one_alone = MPI::n_mpi_processes(MPI_COMM_WORLD) == 1;
    try
    {
      if (!scene)
        scene = scene_of(arguments);
      execute(arguments, *scene);
      return success;
    }
    catch (const sprag::InputError &error)
    {
      return is_first ? tell(error) : bad_input;
    }
    catch (const sprag::AnalysisError &error)
    {
      if (is_first && scene)
        finish(arguments, *scene, error.what(), since);
      return is_first ? tell(error.what()) : analysis_failed;
    }
    catch (const std::exception &error)
    {
      const std::string failure = sprag::message_of(error);
      if (one_alone && scene)
        finish(arguments, *scene, failure, since);
      tell(failure);
      if (!one_alone)
        MPI_Abort(MPI_COMM_WORLD, analysis_failed);
      return analysis_failed;
    }
  }

  std::string fate_of(const sprag::WorkEnd &end)
  {
    const bool by_user = end.asked || end.signal == SIGINT || end.signal == SIGTERM || end.signal == SIGHUP;
    if (by_user)
      return sprag::interruption;
    if (end.signal == SIGKILL)
      return "killed by the system, probably for want of memory; every finished step is kept";
    const std::string reason = end.signal != 0 ? strsignal(end.signal) : "exit status " + std::to_string(end.status);
    return "crashed (" + reason + "); every finished step is kept";
  }

  /// The exit status of a run that was looked after.
  int conclude(const sprag::WorkEnd &end, const Arguments &arguments, const sprag::Scene &scene, const std::timespec &since)
  {
    const bool ended_itself = end.signal == 0 && end.status <= bad_input;
    if (ended_itself && end.status != analysis_failed)
      return end.status;
    const std::string fate = fate_of(end);
    const bool unfinished  = finish(arguments, scene, fate, since);
    return ended_itself && !unfinished ? analysis_failed : tell(fate);
  }

  /// A map or a study is carried out by several processes. A folder that cannot serve is for the run itself to refuse.
  bool is_for_all_cores(const Arguments &arguments, const sprag::Scene &scene, const unsigned int processes)
  {
    return is_run(arguments) && sprag::works_in_parallel(scene.analysis.type) && sprag::works_on_all_cores(processes);
  }

  int run_as_process_of_mpi(const Arguments &arguments, std::optional<sprag::Scene> scene, const std::timespec &since,
                            char **argv)
  {
    // Alone, Open MPI would start a daemon beside the program.
    if (!sprag::under_mpi())
      ::setenv("OMPI_MCA_ess_singleton_isolated", "1", 0);
    int no_arguments = 1;
    dealii::Utilities::MPI::MPI_InitFinalize mpi(no_arguments, argv, 1);
    sprag::hdf5::silence();
    sprag::catch_interrupts();
    return exit_status_of(arguments, std::move(scene), since);
  }

  int run_looked_after(const Arguments &arguments, const std::timespec &since, char **argv)
  {
    if (arguments.file.empty() && arguments.print_parameters && arguments.overrides.empty())
    {
      std::cout << sprag::default_parameters_text();
      return success;
    }
    const sprag::Scene scene     = scene_of(arguments);
    const unsigned int processes = arguments.jobs > 0 ? arguments.jobs : sprag::available_cores();
    const bool on_all_cores      = is_for_all_cores(arguments, scene, processes);
    if (const auto end =
            on_all_cores ? sprag::look_after(SIGTERM, sprag::grace_of_processes) : sprag::look_after(SIGKILL, sprag::grace))
      return conclude(*end, arguments, scene, since);
    if (on_all_cores)
      sprag::become_mpirun(argv, processes);
    return run_as_process_of_mpi(arguments, scene, since, argv);
  }
} // namespace

int main(int argc, char **argv)
{
  CLI::App app("Finite-element contact of the linear friction damper of Yamaguchi & Yoshida");
  Arguments arguments;
  declare(app, arguments);
  try
  {
    app.parse(argc, argv);
  }
  catch (const CLI::ParseError &error)
  {
    return app.exit(error) == 0 ? success : bad_input;
  }
  std::timespec since = {};
  clock_gettime(CLOCK_REALTIME_COARSE, &since); // the clock of file systems
  if (sprag::under_mpi())
    return run_as_process_of_mpi(arguments, {}, since, argv);
  try
  {
    return run_looked_after(arguments, since, argv);
  }
  catch (const sprag::InputError &error)
  {
    return tell(error);
  }
  catch (const std::exception &error)
  {
    return tell(error.what());
  }
}
