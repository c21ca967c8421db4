#pragma once

#include "scene/scene.h"

#include <deal.II/grid/tria.h>

namespace sprag
{
  /// Fills `triangulation` with the scene's lever in lever axes (first axis along the lever from the pivot at the origin, second
  /// from the friction interface into the lever): the built-in `meshes/lever.geo` with the scene's dimensions, or the user's
  /// Mesh/File, a gmsh .geo or .msh of quadrilaterals [mm]. Physical groups: surfaces "lever", "layer" (optional) and "hub"
  /// (optional, rigid), curves "friction face" and "hub"; at least one "hub". Ids as in elastic_body.h.
  /// An elastic cylinder is added, see add_cylinder().
  /// Throws InputError naming the file and what is missing or wrong in it.
  void make_mesh(const Scene &scene, dealii::Triangulation<2> &triangulation);
} // namespace sprag
