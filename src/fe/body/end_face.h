// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include <deal.II/dofs/dof_handler.h>

#include <utility>
#include <vector>

namespace sprag
{
  template <int dim>
  using CellFaces = std::vector<std::pair<typename dealii::DoFHandler<dim>::active_cell_iterator, unsigned int>>;

  /// Returns the degrees of freedom of a cell.
  template <class Cell>
  std::vector<dealii::types::global_dof_index> cell_dofs(const Cell &cell)
  {
    std::vector<dealii::types::global_dof_index> result(cell->get_fe().n_dofs_per_cell());
    cell->get_dof_indices(result);
    return result;
  }

  /// Returns the faces on a boundary.
  template <int dim>
  CellFaces<dim> boundary_faces(const dealii::DoFHandler<dim> &dofs, const dealii::types::boundary_id boundary)
  {
    CellFaces<dim> result;
    for (const auto &cell : dofs.active_cell_iterators())
      for (const unsigned int f : cell->face_indices())
        if (cell->face(f)->at_boundary() && cell->face(f)->boundary_id() == boundary)
          result.emplace_back(cell, f);
    return result;
  }

  /// Finds the boundary faces of the lever's material farthest along the first axis; empty if its end is not straight across.
  template <int dim>
  CellFaces<dim> end_face(const dealii::DoFHandler<dim> &dofs);

  /// Returns the sum of the faces' measures [mm] or, in 3D, [mm^2].
  template <int dim>
  double total_measure(const CellFaces<dim> &faces);
} // namespace sprag
