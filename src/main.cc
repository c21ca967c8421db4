#include "analysis/run.h"
#include "base/errors.h"
#include "base/interrupt.h"
#include "scene/read.h"

#include <deal.II/base/mpi.h>

#include <CLI/CLI.hpp>

#include <iostream>

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
    app.set_version_flag("--version", std::string("sprag " SPRAG_VERSION));
    app.footer("Exit status: 0 success, 1 the analysis failed (finished steps are kept), 2 bad input (nothing is written).");
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
    sprag::run(scene, { arguments.folder.empty() ? "output/" + scene.name : arguments.folder, arguments.quiet });
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
  try
  {
    int no_arguments = 1;
    dealii::Utilities::MPI::MPI_InitFinalize mpi(no_arguments, argv, 1);
    sprag::catch_interrupts();
    execute(arguments);
    return success;
  }
  catch (const sprag::InputError &error)
  {
    std::cerr << error.what() << '\n';
    return bad_input;
  }
  catch (const std::exception &error)
  {
    std::cerr << "sprag: " << error.what() << '\n';
    return analysis_failed;
  }
}
