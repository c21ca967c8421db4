// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "fe/body/cell_elasticity.h"
#include "fe/body/elastic_body.h"

#include <map>
#include <vector>

namespace sprag
{
  /// Returns material and shape of a cell in space up to a shift, in steps of a nanometre: equal cells share stiffness
  /// and mass. In a plane, where cells may be curved, each is like itself alone.
  template <int dim>
  std::vector<long> cell_shape(const typename CellElasticity<dim>::Cell &cell)
  {
    if (dim == 2)
      return { static_cast<long>(cell->active_cell_index()) };
    std::vector<long> result{ static_cast<long>(cell->material_id()) };
    for (const unsigned int v : cell->vertex_indices())
      for (unsigned int d = 0; d < dim; ++d)
        result.push_back(std::lround(1e6 * (cell->vertex(v)[d] - cell->vertex(0)[d])));
    return result;
  }

  /// Stiffnesses of a body's cells without load, found once for equal ones. That of a cell in a plane lives until the
  /// next is asked for.
  template <int dim>
  class CellStiffness
  {
  public:
    /// The body must outlive this.
    explicit CellStiffness(const ElasticBody<dim> &body)
        : elasticity(body.cell_mapping(), body.dofs().get_fe(), body.body_properties())
        , at_rest(body.dofs().get_fe().n_dofs_per_cell())
        , no_forces(at_rest.size())
    {
    }

    const dealii::FullMatrix<double> &operator()(const typename CellElasticity<dim>::Cell &cell)
    {
      if (dim == 2)
        known.clear(); // no other cell is like it
      const auto [found, is_new] = known.try_emplace(cell_shape<dim>(cell), at_rest.size(), at_rest.size());
      if (is_new)
      {
        elasticity.reinit(cell, at_rest);
        elasticity.assemble(found->second, no_forces);
      }
      return found->second;
    }

  private:
    CellElasticity<dim> elasticity;
    const dealii::Vector<double> at_rest;
    dealii::Vector<double> no_forces;
    std::map<std::vector<long>, dealii::FullMatrix<double>> known; ///< by cell_shape()
  };
} // namespace sprag
