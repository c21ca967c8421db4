// SPDX-License-Identifier: GPL-3.0-only
#include "run/in_memory.h"

#include "fe/mesh/lever_mesh.h"
#include "input/scene_key.h"
#include "scene/scene.h"

#include <ctime>

namespace sprag
{
  const Mesh &StaticMeshes::cached_mesh(const Scene &scene)
  {
    const auto new_key = body_key(scene);
    if (mesh && new_key == key)
    {
      saved += cpu_seconds;
      return *mesh;
    }
    const std::clock_t begin = std::clock();
    key.clear();
    mesh = std::make_unique<Mesh>();
    make_mesh(scene, *mesh);
    key         = new_key;
    cpu_seconds = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
    return *mesh;
  }

  InMemory run_in_memory()
  {
    return { std::make_shared<DynamicsMaker>(false, 2), // finite elements in time take two
             std::make_shared<StaticMeshes>() };
  }

  RunOptions make_options(InMemory &in_memory)
  {
    RunOptions options;
    options.quiet     = true;
    options.in_memory = &in_memory;
    return options;
  }

  bool estimates_errors(const Scene &scene, const RunOptions &options)
  {
    return scene.output.errors && (options.in_memory == nullptr || scene.accuracy.chooses_settings());
  }

  std::shared_ptr<DynamicsMaker> dynamics_maker(const RunOptions &options)
  {
    return options.in_memory != nullptr ? options.in_memory->dynamics : std::make_shared<DynamicsMaker>();
  }
} // namespace sprag
