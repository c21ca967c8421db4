// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "fe/mesh/lever_mesh.h"

namespace sprag
{
  /// The mesh of a scene.
  struct MadeMesh : public Mesh
  {
    explicit MadeMesh(const Scene &scene)
    {
      make_mesh(scene, *this);
    }
  };
} // namespace sprag
