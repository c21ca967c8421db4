#include "levers/static_lever.h"

#include "fe/mesh/mesh.h"
#include "fe/statics/contact_penalties.h"
#include "fe/statics/lever_model.h"
#include "scene/scene.h"

namespace sprag
{
  StaticLever make_lever_in_hard_contact(const Scene &scene)
  {
    StaticLever result{ std::make_unique<Mesh>(), nullptr };
    make_mesh(scene, *result.mesh);
    auto properties           = lever_properties(scene);
    properties.penalty_factor = penalty_over_layer::indentation;
    result.model              = std::make_unique<LeverModel>(*result.mesh, std::move(properties));
    return result;
  }
} // namespace sprag
