// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "fe/body/dimension.h"
#include "model/step/model.h"

#include <memory>

namespace sprag
{
  struct Scene;

  /// A meshed lever without inertia and the mesh that it stands on.
  struct LeverOnMesh
  {
    std::unique_ptr<Mesh> mesh;
    std::unique_ptr<Model> model;
  };

  /// Makes the scene's lever with an automatic penalty as stiff as hard contact, to which laws of the reduced models are fitted.
  /// Throws InputError for a mesh that cannot serve.
  LeverOnMesh make_lever_in_hard_contact(const Scene &scene);
} // namespace sprag
