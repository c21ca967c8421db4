// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "base/errors.h"
#include "program/arguments.h"
#include "results/warning.h"

#include <ctime>
#include <functional>
#include <optional>
#include <string>

namespace sprag
{
  struct Scene;

  /// Returns the folder for results, named or after the scene.
  std::string result_folder(const Arguments &arguments, const Scene &scene);

  /// Reads the scene. Throws InputError, also where no file is named.
  Scene load_scene(const Arguments &arguments);

  /// Returns all parameters of the scene in .prm form, defaults where none is named. Throws InputError.
  std::string printed_parameters(const Arguments &arguments);

  // The program reports its outcome by messages on the standard error, its exit status and the files in the folder.

  /// Returns the time by the clock of file systems.
  std::timespec file_time();

  /// Prints what is wrong with the input and returns the exit status.
  int report_error(const InputError &error);

  /// Prints what failed and returns the exit status.
  int report_error(const std::string &failure);

  /// Gives what a run since then has left unfinished its end; returns whether there was anything.
  bool finish(const Arguments &arguments, const Scene &scene, const std::string &status, const std::timespec &since);

  /// Prints that the file is valid and its warnings, unless quiet. Throws AnalysisError where they count as errors.
  void tell_validity(const Arguments &arguments, const Scene &scene, const Warnings &warnings);

  /// The place of a process among those that run a scene together.
  struct Rank
  {
    bool is_first = true;
    bool is_alone = true;
  };

  /// The exit status, and what was thrown.
  struct Outcome
  {
    int status          = success;
    std::string failure = {};
  };

  /// Does `work` with the scene and returns its outcome; what is thrown is told, and what it leaves unfinished gets its end.
  /// A scene that is not given is read from the arguments. Errors of input and analysis come on all ranks alike and are told by
  /// the first; any other may be one rank's own: it passes through where the rank is not alone.
  Outcome run_to_outcome(const Arguments &arguments, std::optional<Scene> scene, const std::timespec &since, const Rank &rank,
                         const std::function<void(const Scene &)> &work);
} // namespace sprag
