// SPDX-License-Identifier: GPL-3.0-only
#include "program/outcome.h"

#include "base/errors.h"
#include "base/system/coloured.h"
#include "base/text.h"
#include "base/version.h"
#include "input/read.h"
#include "program/run_options.h"
#include "results/earlier_result.h"
#include "scene/scene.h"

#include <CLI/CLI.hpp>
#include <iostream>
#include <sstream>
#include <unistd.h>

namespace sprag
{
  namespace
  {
    void declare(CLI::App &app, Arguments &arguments)
    {
      app.add_option("FILE.prm", arguments.file, "The scene: a parameter file; see params/README.md");
      app.add_option("--set", arguments.overrides, "\"Section/Name=value\": overrides a parameter of the file; may be repeated")
          ->allow_extra_args(false);
      app.add_option("--output", arguments.folder, "Folder for results; default output/NAME_OF_THE_FILE");
      app.add_flag("--overwrite", arguments.overwrite, "Replace whatever result is in that folder, and begin anew");
      app.add_flag("--validate", arguments.validate, "Check the file and stop");
      app.add_flag("--print-parameters", arguments.print_parameters, "Print every parameter with its meaning and stop");
      auto *const quiet = app.add_flag("--quiet", arguments.quiet, "Print errors only");
      app.add_flag("--verbose", arguments.verbose, "Print every result that is in /summary")->excludes(quiet);
      app.add_flag("--trust-scripts", arguments.trust_scripts,
                   "Let a .geo in Mesh/File do all that you may, not only read its own folder; see meshes/README.md");
      app.add_option("--jobs", arguments.jobs, "Processes that work on a map or study; default: one a core")
          ->check(CLI::Range(1u, 4096u));
      app.set_help_flag("-h,--help",
                        "Print this help and stop; with SECTION or SECTION/NAME in place of FILE.prm, what that means");
      app.set_version_flag("--version", "sprag " + version());
      app.footer(
          "Exit status: 0 success, 1 the analysis failed or was interrupted (finished steps are kept), 2 bad input (nothing "
          "is written).");
    }

    /// Prints a section or parameter. Returns the exit status.
    int explain(const std::string &name)
    {
      try
      {
        std::cout << help_text(name);
        return success;
      }
      catch (const InputError &error)
      {
        return tell(error);
      }
    }
  } // namespace

  std::string result_folder(const Arguments &arguments, const Scene &scene)
  {
    return arguments.folder.empty() ? "output/" + scene.name : arguments.folder;
  }

  bool is_run(const Arguments &arguments)
  {
    return !arguments.validate && !arguments.print_parameters;
  }

  Scene load_scene(const Arguments &arguments)
  {
    if (arguments.file.empty())
      throw InputError("FILE.prm is missing; try --help");
    return read_scene(arguments.file, arguments.overrides);
  }

  namespace
  {
    constexpr std::size_t most_lines = 40, half_line = 200;

    /// Cuts the middle out of a long line.
    std::string shortened(const std::string &line)
    {
      return line.size() <= 2 * half_line ? line : line.substr(0, half_line) + " [...] " + line.substr(line.size() - half_line);
    }

    /// The content of a file must neither flood the terminal nor reach it as control characters.
    std::string shown(const std::string &message)
    {
      std::istringstream lines(message);
      std::string text;
      std::size_t count = 0;
      for (std::string line; std::getline(lines, line);)
        if (++count <= most_lines)
          text += (text.empty() ? "" : "\n") + printable(shortened(line));
      return count > most_lines ? text + "\nand " + std::to_string(count - most_lines) + " more" : text;
    }
  } // namespace

  std::timespec file_time()
  {
    std::timespec result = {};
    clock_gettime(CLOCK_REALTIME_COARSE, &result);
    return result;
  }

  int tell(const InputError &error)
  {
    std::cerr << coloured(shown(error.what()), STDERR_FILENO, error_colour) << '\n';
    return bad_input;
  }

  int tell(const std::string &failure)
  {
    std::cerr << coloured("sprag: " + shown(failure), STDERR_FILENO, error_colour) << '\n';
    return analysis_failed;
  }

  bool finish(const Arguments &arguments, const Scene &scene, const std::string &status, const std::timespec &since)
  {
    return is_run(arguments) &&
           finish_abandoned(result_folder(arguments, scene) + "/result.h5", parameters_text(scene), status, since);
  }

  void tell_validity(const Arguments &arguments, const Scene &scene, const Warnings &warnings)
  {
    if (!arguments.quiet)
      std::cout << to_text(warnings) << arguments.file << ": valid, " << count_text(warnings) << '\n';
    check_warnings(scene, warnings);
  }

  Outcome run_to_outcome(const Arguments &arguments, std::optional<Scene> scene, const std::timespec &since, const Rank &rank,
                         const std::function<void(const Scene &)> &work)
  {
    try
    {
      if (!scene)
        scene = load_scene(arguments);
      work(*scene);
      return {};
    }
    catch (const InputError &error)
    {
      return { rank.is_first ? tell(error) : bad_input, error.what() };
    }
    catch (const AnalysisError &error)
    {
      if (rank.is_first && scene)
        finish(arguments, *scene, error.what(), since);
      return { rank.is_first ? tell(error.what()) : analysis_failed, error.what() };
    }
    catch (const std::exception &error)
    {
      if (!rank.is_alone)
        throw;
      if (scene)
        finish(arguments, *scene, error.what(), since);
      return { tell(error.what()), error.what() };
    }
  }

  std::optional<int> read_arguments(int argc, char **argv, Arguments &arguments)
  {
    CLI::App app("Finite-element contact of the linear friction damper of Yamaguchi & Yoshida");
    declare(app, arguments);
    try
    {
      app.parse(argc, argv);
    }
    catch (const CLI::CallForHelp &help)
    {
      const auto &words = app.get_option("FILE.prm")->results();
      return words.empty() ? app.exit(help) : explain(words.front());
    }
    catch (const CLI::ParseError &error)
    {
      return app.exit(error) == 0 ? success : bad_input;
    }
    return {};
  }
} // namespace sprag
