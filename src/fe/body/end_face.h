#pragma once

#include <deal.II/dofs/dof_handler.h>

#include <utility>
#include <vector>

namespace sprag
{
  template <int dim>
  using CellFaces = std::vector<std::pair<typename dealii::DoFHandler<dim>::active_cell_iterator, unsigned int>>;

  /// Finds the boundary faces of the lever's material farthest along the first axis; empty if its end is not straight across.
  template <int dim>
  CellFaces<dim> end_face(const dealii::DoFHandler<dim> &dofs);

  /// Returns the sum of the faces' measures [mm] (in 2D).
  template <int dim>
  double total_measure(const CellFaces<dim> &faces);
} // namespace sprag
