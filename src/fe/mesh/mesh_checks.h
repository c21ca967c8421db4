// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "fe/mesh/geometry_script.h"

namespace sprag
{
  /// Checks the mesh of a lever from a file of the user, read by these groups. Returns a line for each of these faults:
  /// nodes that lie on the side of another element without being its corners, as where parts touch and are not joined; parts
  /// that nothing holds; elements of the friction face on the cylinder's side of it.
  template <int dim>
  std::vector<std::string> mesh_mistakes(const MeshGroups &groups, const dealii::Triangulation<dim> &triangulation);

  /// Returns the longest side along the friction face between two places along the lever [mm].
  template <int dim>
  double longest_face_side(const dealii::Triangulation<dim> &triangulation, double first, double last);
} // namespace sprag
