#pragma once

#include "fe/body/dimension.h"
#include "scene/scene.h"

namespace sprag
{
  /// Fills `triangulation` with the scene's lever in lever axes (first axis along the lever from the pivot at the origin, second
  /// from the friction interface into the lever): the built-in `meshes/lever.geo` or `meshes/frame.geo` with the scene's
  /// dimensions, or the user's Mesh/File, a gmsh .geo or .msh of quadrilaterals [mm]. Physical groups: surfaces "lever", "web",
  /// "plate", "layer" and "hub" (rigid), all but the first optional, curves "friction face" and "hub", at least one "hub"; with
  /// a friction plate on sensors surface "plate" and curves "sensor plate" and "sensor lever". Ids as in body_properties.h.
  /// An elastic cylinder is added, see add_cylinder().
  /// Throws InputError naming the file and what is missing or wrong in it.
  void make_mesh(const Scene &scene, Mesh &triangulation);
} // namespace sprag
