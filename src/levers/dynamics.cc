// SPDX-License-Identifier: GPL-3.0-only
#include "levers/dynamics.h"

#include "fe/mesh/lever_mesh.h"
#include "fe/statics/lever_properties.h"
#include "input/scene_key.h"
#include "model/lever/reduced_lever.h"
#include "scene/contact_estimates.h"
#include "scene/held_slide.h"
#include "scene/scene.h"

#include <algorithm>
#include <ctime>

namespace sprag
{
  namespace
  {
    /// Contact points four times as far apart as in quasi-static runs: P moves by 6e-4 of its size, and a step is the faster.
    BodyProperties body_properties(const Scene &scene)
    {
      auto properties          = lever_properties(scene).body;
      properties.point_spacing = scene.geometry.cylinder_radius / 1000.;
      return properties;
    }
  } // namespace

  bool share_mesh(const Scene &a, const Scene &b)
  {
    return body_key(a) == body_key(b);
  }

  DynamicsMaker::DynamicsMaker(const bool store_bases, const std::size_t kept_meshes)
      : store(store_bases)
      , kept(kept_meshes)
  {
  }

  Dynamics DynamicsMaker::make(const Scene &scene, const std::optional<unsigned int> &fewer_modes)
  {
    Dynamics result;
    if (!is_meshed(scene.analysis.model))
    {
      result.reduced = make_reduced_lever(scene);
      return result;
    }
    if (scene.analysis.dimension == 3)
      return make_solid(scene, fewer_modes.value_or(scene.condensed.modes));
    result.lever = find_meshed_lever(scene);
    const PhaseTimer::Scope scope(time, "model");
    const double relaxation = contact_reference(scene).relaxation;
    const auto &bases       = result.lever->condensed;
    const auto lowest       = [&](const auto &basis)
    { return basis && fewer_modes ? std::make_shared<const CondensedBasis>(truncated(*basis, *fewer_modes)) : basis; };
    result.meshed =
        scene.analysis.model == ModelType::condensed
            ? make_condensed_dynamics(scene, *result.lever->body, { lowest(bases.lever), lowest(bases.swinging) }, relaxation)
            : make_finite_element_dynamics(scene, *result.lever->body, result.lever->elements, relaxation);
    return result;
  }

  Dynamics DynamicsMaker::make_solid(const Scene &scene, const unsigned int n_modes)
  {
    if (const auto key = body_key(scene); key != solid.first)
    {
      Mesh plane;
      make_mesh(scene, plane);
      const PhaseTimer::Scope scope(time, "basis");
      solid = { key, std::make_shared<const SolidInTime>(make_solid_in_time(scene, plane)) };
    }
    const PhaseTimer::Scope scope(time, "model");
    Dynamics result;
    result.solid  = solid.second;
    result.meshed = make_solid_dynamics(scene, *result.solid, contact_range(scene), contact_reference(scene).relaxation, n_modes);
    return result;
  }

  std::shared_ptr<const MeshedLever> DynamicsMaker::find_meshed_lever(const Scene &scene)
  {
    const auto key   = body_key(scene);
    const auto found = std::find_if(levers.begin(), levers.end(), [&](const auto &lever) { return lever.first == key; });
    if (found != levers.end())
    {
      saved += found->second->cpu_seconds;
      std::rotate(levers.begin(), found, found + 1);
    }
    else
    {
      levers.emplace_front(key, make_lever(scene, key));
      levers.resize(std::min(levers.size(), kept));
    }
    return levers.front().second;
  }

  std::shared_ptr<const MeshedLever> DynamicsMaker::make_lever(const Scene &scene, const std::string &key)
  {
    const std::clock_t begin = std::clock();
    auto lever               = std::make_shared<MeshedLever>();
    {
      const PhaseTimer::Scope scope(time, "mesh");
      make_mesh(scene, lever->triangulation);
    }
    const PhaseTimer::Scope scope(time, "basis");
    lever->body = std::make_unique<const Body>(lever->triangulation, body_properties(scene));
    if (scene.analysis.model == ModelType::condensed)
      lever->condensed = make_condensed_basis(scene, key, *lever->body, store);
    else
      lever->elements = make_finite_element_basis(scene, *lever->body);
    lever->cpu_seconds = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
    return lever;
  }
} // namespace sprag
