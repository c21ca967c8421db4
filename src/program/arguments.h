// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace sprag
{
  /// The program's exit status.
  constexpr int success = 0, analysis_failed = 1, bad_input = 2;

  /// Options of the command line.
  struct Arguments
  {
    std::string file;
    std::string new_file;                     ///< where to write a scene to begin with
    std::string shipped_scene = "own-device"; ///< scene that it is a copy of
    std::vector<std::string> overrides;
    std::string folder;
    std::string print_parameters; ///< form in which to print them, prm or xml; empty: not at all
    bool validate      = false;
    bool quiet         = false;
    bool verbose       = false; ///< prints all results
    bool overwrite     = false;
    bool trust_scripts = false; ///< runs scripts of meshes with all rights of the user
    unsigned int jobs  = 0;     ///< 0: as many as cores
  };

  /// Reads the command line. Returns the exit status where nothing else is to be done: help and version, which are printed, a
  /// new scene, which is written, and mistakes, which are printed.
  std::optional<int> read_arguments(int argc, char **argv, Arguments &arguments);

  /// Returns whether the arguments request an analysis rather than a check or print of the scene.
  bool is_run(const Arguments &arguments);
} // namespace sprag
