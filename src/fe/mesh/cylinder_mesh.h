#pragma once

#include "scene/scene.h"

#include <deal.II/grid/tria.h>

namespace sprag
{
  /// Adds the scene's elastic cylinder, of `meshes/cylinder.geo`, to a lever's triangulation as a part of its own: about its own
  /// centre, in axes parallel to the lever's, on a SphericalManifold. Fine where it can touch the lever: as wide as a contact
  /// and the change of its direction by bending ask for. BodyProperties::curved keeps the nodes on the circle.
  /// Throws InputError for elements of degree 1 and for an inner radius that leaves no cylinder.
  void add_cylinder(const Scene &scene, dealii::Triangulation<2> &triangulation);
} // namespace sprag
