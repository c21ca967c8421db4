// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "program/run_options.h"

#include <string>

namespace sprag
{
  struct Scene;

  /// Claims the folder for the run of a scene. Throws InputError where the folder cannot serve, another run has it, or
  /// its result.h5 is of a run with other parameters, completed or not, damaged or no result, unless that is to be overwritten;
  /// then what an interrupted run would go on from is removed. It makes nothing. From then on, or once prepare_folder() has made
  /// it, the folder is this process's until that ends, by a lock on the folder itself, which leaves nothing behind; file systems
  /// without locks are taken as they are.
  void claim_folder(const std::string &folder, const Scene &scene, bool overwrite);

  /// Throws InputError if the folder could not be made or written to; makes nothing.
  void require_writable(const std::string &folder);

  /// Makes the run's folder if needed, removes fields of earlier runs unless there is one to go on from, and begins the log.
  /// Throws InputError if nothing can be written there, or if another run has meanwhile made the folder for its result.
  void prepare_folder(const Scene &scene, const RunOptions &options);
} // namespace sprag
