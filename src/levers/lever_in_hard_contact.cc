// SPDX-License-Identifier: GPL-3.0-only
#include "levers/lever_in_hard_contact.h"

#include "fe/mesh/mesh.h"
#include "fe/statics/contact_penalties.h"
#include "fe/statics/static_lever.h"
#include "scene/scene.h"

namespace sprag
{
  LeverOnMesh make_lever_in_hard_contact(const Scene &scene)
  {
    LeverOnMesh result{ std::make_unique<Mesh>(), nullptr };
    make_mesh(scene, *result.mesh);
    auto properties           = lever_properties(scene);
    properties.penalty_factor = indentation_penalty;
    result.model              = std::make_unique<StaticLever<2>>(*result.mesh, std::move(properties));
    return result;
  }
} // namespace sprag
