// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "fe/body/dimension.h"
#include "fe/mesh/geometry_script.h"

namespace sprag
{
  struct Device;

  /// The physical groups of a lever's mesh, in a plane (dimension 2) surfaces and curves, in three dimensions volumes and
  /// surfaces. The scene must outlive them.
  MeshGroups lever_groups(const Device &device, int dimension);

  /// Fills `triangulation` with the scene's lever in lever axes (first axis along the lever from the pivot at the origin, second
  /// from the friction interface into the lever): the built-in `meshes/lever.geo` or `meshes/frame.geo` with the scene's
  /// dimensions, or the user's Mesh/File, a gmsh .geo or .msh of quadrilaterals [mm]. Physical groups: surfaces "lever", "web",
  /// "plate", "layer" and "hub" (rigid), all but the first optional, curves "friction face" and "hub", at least one "hub"; with
  /// a friction plate on sensors surface "plate" and curves "sensor plate" and "sensor lever". Ids as in body_properties.h.
  /// An elastic cylinder is added, see add_cylinder(). A Mesh/File of three dimensions leaves it empty, see read_solid_file().
  /// Throws InputError naming the file and what is missing or wrong in it.
  void make_mesh(const Device &device, Mesh &triangulation);

  /// Adds the scene's elastic cylinder, of `meshes/cylinder.geo`, to a lever's triangulation as a part of its own: about its own
  /// centre, in axes parallel to the lever's, on a SphericalManifold. Fine where it can touch the lever: as wide as a contact
  /// and the change of its direction by bending ask for. BodyProperties::curved keeps the nodes on the circle.
  /// Throws InputError for elements of degree 1 and for an inner radius that leaves no cylinder.
  void add_cylinder(const Device &device, Mesh &triangulation);
} // namespace sprag
