// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "fe/mesh/lever_mesh.h"
#include "scene/scene.h"

namespace sprag
{
  /// A scene's model with the mesh that it needs. Properties: what the model is made from besides.
  template <class Model>
  class Meshed
  {
  public:
    template <class Properties>
    Meshed(const Scene &scene, const Properties &properties)
        : model(mesh(scene), properties)
    {
    }

  private:
    const dealii::Triangulation<2> &mesh(const Scene &scene)
    {
      make_mesh(scene, triangulation);
      return triangulation;
    }

    dealii::Triangulation<2> triangulation;

  public:
    Model model;
  };
} // namespace sprag
