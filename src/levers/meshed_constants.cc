// SPDX-License-Identifier: GPL-3.0-only
#include "levers/meshed_constants.h"

#include "fe/dynamics/dynamic_face_lever.h"
#include "fe/leaf/leaf_spring.h"
#include "fe/mesh/lever_mesh.h"
#include "fe/statics/contact_penalties.h"
#include "fe/statics/lever_properties.h"
#include "fe/statics/static_lever.h"
#include "scene/closed_form.h"
#include "scene/lever_shape.h"
#include "scene/scene.h"

namespace sprag
{
  double leaf_stiffness(const Scene &scene, const double thickness)
  {
    LeafSpring leaf = scene.spring.leaf;
    leaf.thickness  = thickness;
    return leaf_behaviour(leaf, leaf.plane, 0., 0.).law.linear_stiffness();
  }

  double inertia_as_built(const Scene &scene)
  {
    Scene built         = scene;
    built.lever.inertia = InertiaSource::as_built;
    Mesh triangulation;
    make_mesh(built, triangulation);
    const Body body(triangulation, lever_properties(built).body);
    return mesh_inertia(built, body);
  }

  MeshedConstants meshed_constants(const Scene &scene)
  {
    Mesh triangulation;
    make_mesh(scene, triangulation);
    const Body body(triangulation, lever_properties(scene).body);
    const auto [nearest, farthest] = contact_surroundings(scene);
    return { mesh_inertia(scene, body), effective_bending(body, nearest, farthest) };
  }

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
