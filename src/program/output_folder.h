// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "program/run_options.h"

#include <functional>
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

  /// Makes the run's folder if needed, removes fields of earlier runs unless one is resumed, and begins the log.
  /// Throws InputError if nothing can be written there, or if another run has meanwhile made the folder for its result.
  void prepare_folder(const Scene &scene, const RunOptions &options);

  // Files of a run in its folder beside its results, until it is over.

  inline constexpr char log_name[]             = "run.log";
  inline constexpr char checkpoint_name[]      = "run.checkpoint";
  inline constexpr char next_checkpoint_name[] = "run.checkpoint.new"; ///< while it is written
  inline constexpr char row_log_name[]         = "run.journal";

  /// Returns the name of the results log of an analysis, "map".
  inline std::string results_log_name(const std::string &analysis)
  {
    return analysis + ".journal";
  }

  /// Returns the first line of the results log of an analysis, "map", whose pieces depend on the scene with this key and on the
  /// build of the program.
  std::string results_log_header(const std::string &what, const std::string &scene_key);

  /// Returns whether there is something in a folder that the run of this scene goes on from. A checkpoint counts by the scene's
  /// parameters, whatever the files hold that they name.
  bool has_progress(const std::string &folder, const Scene &scene);

  /// Removes the checkpoint of a run.
  void remove_checkpoint(const std::string &folder);

  /// Returns whether a file in a folder of results has a name that FieldFiles gives, of leaf springs of earlier versions
  /// included.
  bool is_field_file(const std::string &name);

  /// Removes the files of a folder that are named so.
  void remove_files(const std::string &folder, const std::function<bool(const std::string &)> &is_named_so);
} // namespace sprag
