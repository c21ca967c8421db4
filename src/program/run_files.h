#pragma once

#include <string>

namespace sprag
{
  // Files of a run in its folder beside its results, until it is over.

  inline constexpr char log_name[]             = "run.log";
  inline constexpr char checkpoint_name[]      = "run.checkpoint";
  inline constexpr char next_checkpoint_name[] = "run.checkpoint.new"; ///< while it is written
  inline constexpr char row_journal_name[]     = "run.journal";
  inline constexpr char map_journal_name[]     = "map.journal";
  inline constexpr char study_journal_name[]   = "study.journal";

  /// Returns whether there is something in a folder that a run may go on from.
  bool has_progress(const std::string &folder);

  /// Removes what a run goes on from.
  void remove_checkpoint(const std::string &folder);
} // namespace sprag
