// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "analytic/measures.h"

#include <memory>
#include <utility>

namespace sprag
{
  class DynamicsMaker;
  class StaticMeshes;

  /// Holds what the runs of one process share that write no files: their meshes, and the results of the last run.
  /// run_in_memory() makes one.
  struct InMemory
  {
    InMemory(std::shared_ptr<DynamicsMaker> maker, std::shared_ptr<StaticMeshes> shared)
        : dynamics(std::move(maker))
        , meshes(std::move(shared))
    {
    }

    std::shared_ptr<DynamicsMaker> dynamics;
    std::shared_ptr<StaticMeshes> meshes;
    Comparable found;
  };
} // namespace sprag
