#pragma once

#include "analytic/measures.h"

#include <memory>
#include <utility>

namespace sprag
{
  class DynamicsMaker;
  class StaticMeshes;

  /// What one process has for its runs that write no files: the meshes that they share, and what the last of them found.
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
