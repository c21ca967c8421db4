#pragma once

#include "analysis/study/measures.h"
#include "levers/dynamics.h"
#include "levers/static_meshes.h"
#include "results/warning.h"
#include "run/run.h"

#include <memory>

namespace sprag
{
  /// What one process has for its runs that write no files: the meshes that they share, and what the last of them found.
  struct InMemory
  {
    std::shared_ptr<DynamicsMaker> dynamics = std::make_shared<DynamicsMaker>(false, 2); // finite elements in time take two
    std::shared_ptr<StaticMeshes> meshes    = std::make_shared<StaticMeshes>();
    Comparable found                        = {};
  };

  /// Returns whether a run estimates the errors of its results by others, which cost more than the run: not in memory, where runs
  /// stand beside finer ones.
  bool estimates_errors(const RunOptions &options);

  /// Returns what makes the models of a run in time: all runs in memory share one.
  std::shared_ptr<DynamicsMaker> dynamics_maker(const RunOptions &options);

  /// Returns what makes the mesh of a run without inertia, likewise.
  std::shared_ptr<StaticMeshes> static_meshes(const RunOptions &options);
} // namespace sprag
