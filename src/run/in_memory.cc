// SPDX-License-Identifier: GPL-3.0-only
#include "run/in_memory.h"

namespace sprag
{
  InMemory run_in_memory()
  {
    return { std::make_shared<DynamicsMaker>(false, 2), // finite elements in time take two
             std::make_shared<StaticMeshes>() };
  }

  RunOptions options_of(InMemory &in_memory)
  {
    RunOptions options;
    options.quiet     = true;
    options.in_memory = &in_memory;
    return options;
  }

  bool estimates_errors(const RunOptions &options)
  {
    return options.in_memory == nullptr;
  }

  std::shared_ptr<DynamicsMaker> dynamics_maker(const RunOptions &options)
  {
    return options.in_memory != nullptr ? options.in_memory->dynamics : std::make_shared<DynamicsMaker>();
  }

  std::shared_ptr<StaticMeshes> static_meshes(const RunOptions &options)
  {
    return options.in_memory != nullptr ? options.in_memory->meshes : std::make_shared<StaticMeshes>();
  }
} // namespace sprag
