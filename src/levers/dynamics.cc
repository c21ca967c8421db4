#include "levers/dynamics.h"

#include "fe/mesh/mesh.h"
#include "fe/statics/lever_properties.h"
#include "model/reduced_lever.h"
#include "scene/contact_reference.h"
#include "scene/scene_key.h"

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

  DynamicsMaker::DynamicsMaker(const bool store_bases)
      : store(store_bases)
  {
  }

  Dynamics DynamicsMaker::make(const Scene &scene)
  {
    Dynamics result;
    const bool condensed = scene.analysis.model == ModelType::condensed;
    if (!is_meshed(scene.analysis.model))
    {
      result.reduced = make_reduced_lever(scene);
      return result;
    }
    if (const auto key = body_key(scene); key != last_key)
    {
      auto lever = std::make_shared<MeshedLever>();
      {
        const PhaseTimer::Scope scope(time, "mesh");
        make_mesh(scene, lever->triangulation);
      }
      const PhaseTimer::Scope scope(time, "basis");
      lever->body = std::make_unique<const Body>(lever->triangulation, body_properties(scene));
      if (condensed)
        lever->condensed = make_condensed_basis(scene, *lever->body, store);
      else
        lever->elements = make_finite_element_basis(scene, *lever->body);
      last     = lever;
      last_key = key;
    }
    const PhaseTimer::Scope scope(time, "model");
    result.lever            = last;
    const double relaxation = contact_reference(scene).relaxation;
    result.meshed           = condensed ? make_condensed_dynamics(scene, *last->body, last->condensed, relaxation)
                                        : make_finite_element_dynamics(scene, *last->body, last->elements, relaxation);
    return result;
  }
} // namespace sprag
