// SPDX-License-Identifier: GPL-3.0-only
#include "fe/body/end_face.h"

#include "base/ranges.h"
#include "fe/body/body_properties.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sprag
{
  using namespace dealii;

  template <int dim>
  CellFaces<dim> end_face(const DoFHandler<dim> &dofs)
  {
    double end    = std::numeric_limits<double>::lowest();
    double extent = 0.;
    for (const auto &cell : dofs.active_cell_iterators())
      if (cell->material_id() == material_id::lever)
        for (const unsigned int v : cell->vertex_indices())
        {
          end    = std::max(end, cell->vertex(v)[0]);
          extent = std::max(extent, std::abs(cell->vertex(v)[0]));
        }
    CellFaces<dim> result;
    for (const auto &cell : dofs.active_cell_iterators())
      if (cell->material_id() == material_id::lever)
        for (const unsigned int f : cell->face_indices())
        {
          bool at_end = cell->face(f)->at_boundary();
          for (unsigned int v = 0; v < cell->face(f)->n_vertices(); ++v)
            at_end = at_end && cell->face(f)->vertex(v)[0] > end - 1e-6 * extent;
          if (at_end)
            result.emplace_back(cell, f);
        }
    return result;
  }

  template <int dim>
  double total_measure(const CellFaces<dim> &faces)
  {
    return sum_over(faces, [](const auto &face) { return face.first->face(face.second)->measure(); });
  }

  template CellFaces<2> end_face(const DoFHandler<2> &);
  template CellFaces<3> end_face(const DoFHandler<3> &);
  template double total_measure<2>(const CellFaces<2> &);
  template double total_measure<3>(const CellFaces<3> &);
} // namespace sprag
