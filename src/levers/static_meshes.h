// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "fe/body/dimension.h"

#include <memory>
#include <string>

namespace sprag
{
  struct Scene;

  /// Makes meshes of levers without inertia, one after another; one that is as the last is not made again.
  class StaticMeshes
  {
  public:
    /// Returns the scene's mesh, which lives until the next one is asked for. Throws InputError for one that cannot serve.
    const Mesh &mesh_of(const Scene &scene);

    /// Returns the CPU time that meshes which were used again did not take again [s].
    double seconds_saved() const
    {
      return saved;
    }

  private:
    std::string key;
    std::unique_ptr<Mesh> mesh;
    double cpu_seconds = 0.; ///< that it took
    double saved       = 0.;
  };
} // namespace sprag
