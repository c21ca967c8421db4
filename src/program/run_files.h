// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include <string>

namespace sprag
{
  struct Scene;

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

  /// Removes what a run goes on from.
  void remove_checkpoint(const std::string &folder);
} // namespace sprag
