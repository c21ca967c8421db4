// SPDX-License-Identifier: GPL-3.0-only
#include "fe/solid/finite_strain.h"

namespace sprag
{
  using namespace dealii;

  FiniteStrain::FiniteStrain(const SolidBody &body_)
      : body(body_)
      , stiffness({ body.cell_mapping(), body.dofs(), body.held(), body.body_properties() }, {}, {})
      , elasticity(body.cell_mapping(), body.dofs().get_fe(), body.body_properties())
      , of_cell(body.dofs().get_fe().n_dofs_per_cell())
  {
    for (const auto &cell : body.dofs().active_cell_iterators())
      if (cell->material_id() != material_id::hub)
      {
        std::vector<types::global_dof_index> dofs(of_cell.size());
        cell->get_dof_indices(dofs);
        cells.push_back({ cell, std::move(dofs) });
      }
  }

  const Vector<double> &FiniteStrain::of(const Cell &cell, const Vector<double> &displacement)
  {
    for (unsigned int i = 0; i < cell.dofs.size(); ++i)
      of_cell[i] = displacement[cell.dofs[i]];
    return of_cell;
  }

  void FiniteStrain::add(const PortLoads &on_face, std::vector<double> &loads) const
  {
    for (unsigned int i = 0; i < on_face.ports.size(); ++i)
      if (const unsigned int dof = dof_of_port(body, on_face.ports[i]); !body.is_held(dof))
        loads[dof] += on_face.values[i];
  }

  Vector<double> FiniteStrain::unbalance(const Vector<double> &displacement, const PortLoads &on_face)
  {
    std::vector<double> loads(body.n_dofs(), 0.);
    Vector<double> internal(of_cell.size());
    for (const auto &cell : cells)
    {
      elasticity.reinit(cell.cell, of(cell, displacement));
      elasticity.find_forces(internal);
      for (unsigned int i = 0; i < cell.dofs.size(); ++i)
        if (!body.is_held(cell.dofs[i]))
          loads[cell.dofs[i]] += internal[i];
    }
    stiffness.subtract(std::vector<double>(displacement.begin(), displacement.end()), loads);
    for (double &load : loads)
      load = -load;
    add(on_face, loads);
    body.respond(loads);
    Vector<double> result(loads.begin(), loads.end());
    result -= displacement;
    return result;
  }

  Vector<double> FiniteStrain::correction(const Vector<double> &unbalance, const PortLoads &change) const
  {
    std::vector<double> loads(body.n_dofs(), 0.);
    add(change, loads);
    body.respond(loads);
    Vector<double> result(loads.begin(), loads.end());
    return result += unbalance;
  }
} // namespace sprag
