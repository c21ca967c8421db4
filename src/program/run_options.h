// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "analytic/measures.h"

#include <memory>
#include <string>

namespace sprag
{
  class DynamicsMaker;
  class RunLog;
  class StaticMeshes;

  /// Holds what the runs of one process share that write no files: their meshes, and the results of the last run.
  /// run_in_memory() makes one.
  struct InMemory
  {
    std::shared_ptr<DynamicsMaker> dynamics;
    std::shared_ptr<StaticMeshes> meshes;
    Comparable found = {};
  };

  /// Says where a run writes its results, what it prints and which processes share it.
  struct RunOptions
  {
    std::string folder; ///< for results; made if it does not exist
    bool quiet             = false;
    bool verbose           = false;   ///< prints all of a summary
    RunLog *log            = nullptr; ///< begins in the folder once that is made; null: none
    unsigned int processes = 1;       ///< that run the scene together
    InMemory *in_memory    = nullptr; ///< for a run that writes no files, in place of a folder; else null
    std::string chosen     = {};      ///< settings that follow from the scene's Accuracy, "Section/Name = VALUE; ..."
  };
} // namespace sprag
