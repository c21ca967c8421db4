#include "analysis/recorder.h"
#include "analysis/run.h"
#include "base/all_cores.h"
#include "base/errors.h"
#include "base/interrupt.h"
#include "scene/read.h"

#include <cstdlib>
#include <deal.II/base/mpi.h>

#include <CLI/CLI.hpp>

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
    unsigned int jobs     = 0; ///< 0: as many as cores
  };

  void declare(CLI::App &app, Arguments &arguments)
  {
    app.add_option("FILE.prm", arguments.file, "The scene: a parameter file; see params/README.md");
    app.add_option("--set", arguments.overrides, "\"Section/Name=value\": overrides a parameter of the file; may be repeated")
        ->allow_extra_args(false);
    app.add_option("--output", arguments.folder, "Folder for results; default output/NAME_OF_THE_FILE");
    app.add_flag("--validate", arguments.validate, "Check the file and stop");
    app.add_flag("--print-parameters", arguments.print_parameters, "Print every parameter with its meaning and stop");
    app.add_flag("--quiet", arguments.quiet, "Print errors only");
    app.add_option("--jobs", arguments.jobs, "Processes that work on a map; default: one a core")->check(CLI::PositiveNumber);
    app.set_version_flag("--version", std::string("sprag " SPRAG_VERSION));
    app.footer("Exit status: 0 success, 1 the analysis failed (finished steps are kept), 2 bad input (nothing is written).");
  }

  std::string folder_of(const Arguments &arguments, const sprag::Scene &scene)
  {
    return arguments.folder.empty() ? "output/" + scene.name : arguments.folder;
  }

  void execute(const Arguments &arguments)
  {
    if (arguments.file.empty())
    {
      if (!arguments.print_parameters || !arguments.overrides.empty())
        throw sprag::InputError("FILE.prm is missing; try --help");
      std::cout << sprag::default_parameters_text();
      return;
    }
    const auto scene = sprag::read_scene(arguments.file, arguments.overrides);
    if (arguments.print_parameters)
    {
      std::cout << scene.parameters_text;
      return;
    }
    if (arguments.validate)
    {
      sprag::validate(scene);
      if (!arguments.quiet)
        std::cout << arguments.file << ": valid\n";
      return;
    }
    const bool alone = dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) == 1;
    if (!alone && scene.analysis.type != sprag::AnalysisType::map)
      throw sprag::InputError("only Analysis/Type = map runs in several processes: leave out mpirun");
    sprag::run(scene, { folder_of(arguments, scene), arguments.quiet });
  }

  /// Exit status of a map that was carried out by several processes; none where there is no such map, or nothing to be carried
  /// out.
  std::optional<int> run_on_all_cores(const Arguments &arguments, char **argv)
  {
    if (arguments.file.empty() || arguments.validate || arguments.print_parameters)
      return {};
    try
    {
      const auto scene = sprag::read_scene(arguments.file, arguments.overrides);
      sprag::require_writable(folder_of(arguments, scene));
      if (scene.analysis.type == sprag::AnalysisType::map)
        return sprag::run_under_mpi(argv, arguments.jobs > 0 ? arguments.jobs : sprag::available_cores());
    }
    catch (const sprag::InputError &)
    {
      // To be reported by the run itself.
    }
    return {};
  }

  /// Errors of an analysis come on all ranks alike and are told by the first; any other may be one rank's own.
  int exit_status_of(const Arguments &arguments)
  {
    namespace MPI        = dealii::Utilities::MPI;
    const bool is_first  = MPI::this_mpi_process(MPI_COMM_WORLD) == 0;
    const bool one_alone = MPI::n_mpi_processes(MPI_COMM_WORLD) == 1;
    try
    {
      execute(arguments);
      return success;
    }
    catch (const sprag::InputError &error)
    {
      if (is_first)
        std::cerr << error.what() << '\n';
      return bad_input;
    }
    catch (const sprag::AnalysisError &error)
    {
      if (is_first)
        std::cerr << "sprag: " << error.what() << '\n';
      return analysis_failed;
    }
    catch (const std::exception &error)
    {
      std::cerr << "sprag: " << error.what() << '\n';
      if (!one_alone)
        MPI_Abort(MPI_COMM_WORLD, analysis_failed);
      return analysis_failed;
    }
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
  if (const auto status = run_on_all_cores(arguments, argv))
    return *status;
  // Alone, Open MPI would start a daemon beside the program.
  if (!std::getenv("OMPI_COMM_WORLD_SIZE"))
    setenv("OMPI_MCA_ess_singleton_isolated", "1", 0);
  int no_arguments = 1;
  dealii::Utilities::MPI::MPI_InitFinalize mpi(no_arguments, argv, 1);
  sprag::catch_interrupts();
  return exit_status_of(arguments);
}
