// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include <deal.II/grid/tria.h>

namespace sprag
{
  struct Device;

  /// Returns whether the scene has a Mesh/File with volumes for three dimensions. Throws InputError for one that cannot be read.
  bool has_solid_file(const Device &device);

  /// Fills `triangulation` with the lever of such a file, a gmsh .geo or .msh of hexahedra in lever axes, z across the width from
  /// its middle [mm]. Physical groups as in make_mesh(), of volumes in place of surfaces and of surfaces in place of curves. The
  /// friction face must be flat, as wide as Lever/Width, and its sides rectangles in lines along x and z: contact follows lines
  /// of nodes. Throws InputError naming the file and what is missing or wrong in it.
  void read_solid_file(const Device &device, dealii::Triangulation<3> &triangulation);

  /// Throws what read_solid_file() throws.
  void check_solid_file(const Device &device);

  /// Returns the longest side along the friction face of a scene's Mesh/File, plane or solid, where the contact sweeps [mm].
  /// Throws what make_mesh() and read_solid_file() throw.
  double own_face_size(const Device &device);
} // namespace sprag
