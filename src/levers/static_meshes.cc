// SPDX-License-Identifier: GPL-3.0-only
#include "levers/static_meshes.h"

#include "fe/mesh/mesh.h"
#include "scene/scene_key.h"

#include <ctime>

namespace sprag
{
  const Mesh &StaticMeshes::mesh_of(const Scene &scene)
  {
    const auto wanted = body_key(scene);
    if (mesh && wanted == key)
    {
      saved += cpu_seconds;
      return *mesh;
    }
    const std::clock_t begin = std::clock();
    key.clear();
    mesh = std::make_unique<Mesh>();
    make_mesh(scene, *mesh);
    key         = wanted;
    cpu_seconds = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
    return *mesh;
  }
} // namespace sprag
