// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "bar_on_cylinder.h"
#include "fe/mesh/lever_mesh.h"
#include "scene/scene.h"

namespace sprag
{
  /// The bar of bar_on_cylinder() with an elastic cylinder, on a rigid core of half its radius.
  class MeshedPair
  {
  public:
    explicit MeshedPair(const double young_modulus = 5000.)
        : triangulation(std::make_unique<dealii::Triangulation<2>>())
    {
      const Bar bar = bar_on_cylinder();
      make_bar(bar, *triangulation);
      Scene scene;
      scene.geometry.cylinder_radius = 6.;
      scene.layer.thickness          = bar.layer;
      scene.cylinder.type            = CylinderType::solid;
      scene.cylinder.inner_radius    = 3.;
      scene.cylinder.face_size       = 0.3;
      add_cylinder(scene, *triangulation);
      auto properties                             = bar_properties(bar, 0.3);
      properties.curved                           = true;
      properties.constants[material_id::cylinder] = { young_modulus, 0.3 };
      body                                        = std::make_unique<ElasticBody<2>>(*triangulation, properties);
    }

    const ElasticBody<2> &operator*() const
    {
      return *body;
    }

  private:
    std::unique_ptr<dealii::Triangulation<2>> triangulation;
    std::unique_ptr<ElasticBody<2>> body;
  };
} // namespace sprag
