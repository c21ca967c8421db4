// SPDX-License-Identifier: GPL-3.0-only
#include "program/outcome.h"

#include "base/errors.h"
#include "base/system/terminal.h"
#include "base/text.h"
#include "input/read.h"
#include "report/warnings.h"
#include "results/earlier_result.h"
#include "scene/scene.h"

#include <iostream>
#include <sstream>
#include <unistd.h>

namespace sprag
{
  std::string result_folder(const Arguments &arguments, const Scene &scene)
  {
    return arguments.folder.empty() ? "output/" + scene.name : arguments.folder;
  }

  Scene load_scene(const Arguments &arguments)
  {
    if (arguments.file.empty())
      throw InputError("FILE.prm is missing; try --help");
    return read_scene(arguments.file, arguments.overrides);
  }

  std::string printed_parameters(const Arguments &arguments)
  {
    const bool are_defaults = arguments.file.empty() && arguments.overrides.empty();
    return are_defaults ? default_parameters_text() : parameters_text(load_scene(arguments));
  }

  namespace
  {
    constexpr std::size_t most_lines = 40, half_line = 200;

    /// Cuts the middle out of a long line.
    std::string shortened(const std::string &line)
    {
      return line.size() <= 2 * half_line ? line : line.substr(0, half_line) + " [...] " + line.substr(line.size() - half_line);
    }

    /// Returns the first lines of a message, without control characters.
    std::string terminal_text(const std::string &message, const std::function<std::string(const std::string &)> &line_text)
    {
      std::istringstream lines(message);
      std::string text;
      std::size_t count = 0;
      for (std::string line; std::getline(lines, line);)
        if (++count <= most_lines)
          text += (text.empty() ? "" : "\n") + printable(line_text(line));
      return count > most_lines ? text + "\nand " + std::to_string(count - most_lines) + " more" : text;
    }
  } // namespace

  std::timespec file_time()
  {
    std::timespec result = {};
    clock_gettime(CLOCK_REALTIME_COARSE, &result);
    return result;
  }

  int report_error(const InputError &error)
  {
    // A message quotes a file, whose content must not flood the terminal.
    std::cerr << coloured(terminal_text(error.what(), shortened), STDERR_FILENO, error_colour) << '\n';
    return bad_input;
  }

  int report_error(const std::string &failure)
  {
    // A design may say much, of which a part would mislead.
    const auto whole = [](const std::string &line) { return line; };
    std::cerr << coloured("sprag: " + terminal_text(failure, whole), STDERR_FILENO, error_colour) << '\n';
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
      return { rank.is_first ? report_error(error) : bad_input, error.what() };
    }
    catch (const AnalysisError &error)
    {
      if (rank.is_first && scene)
        finish(arguments, *scene, error.what(), since);
      return { rank.is_first ? report_error(error.what()) : analysis_failed, error.what() };
    }
    catch (const std::exception &error)
    {
      if (!rank.is_alone)
        throw;
      if (scene)
        finish(arguments, *scene, error.what(), since);
      return { report_error(error.what()), error.what() };
    }
  }
} // namespace sprag
