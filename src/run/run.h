// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "program/run_options.h"

#include <iosfwd>

namespace sprag
{
  struct Scene;

  /// Throws InputError where an analysis gains nothing from as many processes of MPI: one that shares nothing, or a body in three
  /// dimensions that is too small for them.
  void require_useful_processes(const Scene &scene, unsigned int processes);

  /// Checks that the scene's mesh can serve, which read_scene() cannot, and throws InputError if not. Returns the warnings
  /// that follow from the scene alone.
  Warnings validate(const Scene &scene);

  /// Prints what of a scene follows from its Accuracy and what the run on `processes` processes with results in `folder` will
  /// cost.
  void print_expectations(const Scene &scene, unsigned int processes, const std::string &folder);

  /// Carries out the scene's analysis with its model and writes results into the folder. Throws InputError, before anything is
  /// written, for meshes and folders that cannot serve; AnalysisError when the analysis fails or deviates from the closed form by
  /// more than the scene admits, after every finished step was written, or has warnings with Analysis/Warnings = error. At the
  /// end the warnings are printed on the standard output, counted in its last line, unless quiet.
  void run(const Scene &scene, const RunOptions &options);
} // namespace sprag
