// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "base/ranges.h"
#include "fe/body/body_properties.h"
#include "fe/mesh/geometry_script.h"

namespace sprag
{
  /// A side on the boundary and the cell it belongs to.
  template <int dim>
  struct BoundarySide
  {
    typename dealii::Triangulation<dim>::face_iterator side;
    typename dealii::Triangulation<dim>::active_cell_iterator cell;
  };

  template <int dim>
  std::vector<BoundarySide<dim>> find_boundary(const dealii::Triangulation<dim> &triangulation)
  {
    std::vector<BoundarySide<dim>> result;
    for (const auto &cell : triangulation.active_cell_iterators())
      for (const auto &side : cell->face_iterators())
        if (side->at_boundary())
          result.push_back({ side, cell });
    return result;
  }

  template <int dim>
  std::vector<BoundarySide<dim>> friction_face_sides(const dealii::Triangulation<dim> &triangulation)
  {
    return filtered(find_boundary(triangulation),
                    [](const auto &found) { return found.side->boundary_id() == boundary_id::friction_face; });
  }

  /// Checks the mesh of a lever from a file of the user, read by these groups. Returns a line for each of these faults:
  /// nodes that lie on the side of another element without being its corners, as where parts touch and are not joined; parts
  /// that nothing holds; elements of the friction face on the cylinder's side of it.
  template <int dim>
  std::vector<std::string> mesh_mistakes(const MeshGroups &groups, const dealii::Triangulation<dim> &triangulation);

  /// Returns the longest side along the friction face between two places along the lever [mm].
  template <int dim>
  double longest_face_side(const dealii::Triangulation<dim> &triangulation, double first, double last);
} // namespace sprag
