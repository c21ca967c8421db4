// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "analytic/measures.h"
#include "base/archive.h"

#include <string>
#include <vector>

namespace sprag
{
  enum class RunOutcome
  {
    completed,
    failed, ///< the analysis could not be carried to its end
    refused ///< the scene is not possible
  };

  /// Returns "completed", "failed" or "refused".
  std::string outcome_name(RunOutcome outcome);

  /// Result of a run that a study keeps.
  struct StudyRecord
  {
    std::size_t run    = 0; ///< index among the points of the study; their number for the reference
    RunOutcome outcome = RunOutcome::completed;
    std::string reason;                ///< of a run that is not completed
    double cpu_time    = 0.;           ///< that the run would take alone, meshes that it shares with others included [s]
    double cpu_spent   = 0.;           ///< that it took [s]
    double work        = 0.;           ///< a count that is the same each time it is run; NaN where nobody counts
    double wall_time   = 0.;           ///< [s]
    double peak_memory = 0.;           ///< of its process while it ran [MiB]
    std::vector<std::string> warnings; ///< their names
    Comparable found;                  ///< of a completed run
  };

  void serialise(Archive &archive, StudyRecord &record);
} // namespace sprag
