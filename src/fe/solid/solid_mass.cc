// SPDX-License-Identifier: GPL-3.0-only
#include "fe/solid/solid_mass.h"

#include "fe/body/end_face.h"
#include "fe/solid/solid_stiffness.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_values.h>

namespace sprag
{
  using namespace dealii;

  namespace
  {
    /// Mass of unit density between the scalar shape functions of a cell.
    FullMatrix<double> unit_mass(const FEValuesBase<3> &values)
    {
      const auto &fe       = values.get_fe();
      const unsigned int n = fe.base_element(0).n_dofs_per_cell();
      FullMatrix<double> result(n, n);
      for (const unsigned int q : values.quadrature_point_indices())
        for (unsigned int a = 0; a < n; ++a)
          for (unsigned int b = 0; b < n; ++b)
            result(a, b) += values.JxW(q) * values.shape_value(fe.component_to_system_index(0, a), q) *
                            values.shape_value(fe.component_to_system_index(0, b), q);
      return result;
    }

    /// Degrees of freedom of each node of a cell.
    std::vector<std::array<unsigned int, 3>> dofs_of_nodes(const DoFHandler<3>::active_cell_iterator &cell)
    {
      const auto &fe = cell->get_fe();
      std::vector<types::global_dof_index> indices(fe.n_dofs_per_cell());
      cell->get_dof_indices(indices);
      std::vector<std::array<unsigned int, 3>> result(fe.base_element(0).n_dofs_per_cell());
      for (unsigned int a = 0; a < result.size(); ++a)
        for (unsigned int d = 0; d < 3; ++d)
          result[a][d] = static_cast<unsigned int>(indices[fe.component_to_system_index(d, a)]);
      return result;
    }
  } // namespace

  SolidMass::SolidMass(const SolidBody &body, const LeverInertia &inertia)
      : hub(inertia.hub + inertia.leaf.inertia)
      , rotation_arms(body.n_dofs())
      , component(body.n_dofs())
  {
    find_arms(body);
    const auto inertia_of_body = [&] { return rotation_arms * (*this)(rotation_arms); };
    if (inertia.tip_mass > 0.)
      add_tip(body, inertia.tip_mass);
    const double added = inertia_of_body() + hub;
    const auto of_tip  = cells.size();
    find_cells(body, inertia);
    const double of_cells = inertia_of_body() - (added - hub);
    density_factor        = scaling_of_densities(inertia, of_cells, added);
    moment_of_inertia     = density_factor * of_cells + added;
    for (std::size_t i = of_tip; i < cells.size(); ++i)
      cells[i].density *= density_factor;
    Vector<double> along(body.n_dofs());
    for (unsigned int dof = 0; dof < body.n_dofs(); ++dof)
      along[dof] = component[dof] == 0 ? 1. : 0.;
    total_mass = along * (*this)(along) + inertia.leaf.mass;
  }

  void SolidMass::find_arms(const SolidBody &body)
  {
    std::vector<Point<3>> places(body.n_dofs());
    DoFTools::map_dofs_to_support_points(body.cell_mapping(), body.dofs(), places);
    const auto &fe = body.dofs().get_fe();
    std::vector<types::global_dof_index> indices(fe.n_dofs_per_cell());
    for (const auto &cell : body.dofs().active_cell_iterators())
    {
      cell->get_dof_indices(indices);
      for (unsigned int i = 0; i < indices.size(); ++i)
      {
        const auto direction      = fe.system_to_component_index(i).first;
        component[indices[i]]     = static_cast<char>(direction);
        const auto &place         = places[indices[i]];
        rotation_arms[indices[i]] = direction == 0 ? -place[1] : direction == 1 ? place[0] : 0.;
      }
    }
    find_mirrored(places);
  }

  void SolidMass::find_mirrored(const std::vector<Point<3>> &places)
  {
    const auto key = [&](const unsigned int dof, const double side)
    {
      const auto &place = places[dof];
      return std::array<long, 4>{ { std::lround(1e6 * place[0]), std::lround(1e6 * place[1]), std::lround(1e6 * side * place[2]),
                                    component[dof] } };
    };
    std::map<std::array<long, 4>, unsigned int> known;
    for (unsigned int dof = 0; dof < places.size(); ++dof)
      known[key(dof, 1.)] = dof;
    for (unsigned int dof = 0; dof < places.size(); ++dof)
    {
      const auto found = known.find(key(dof, -1.));
      if (found == known.end())
        return mirrored.clear();
      mirrored.push_back(found->second);
    }
  }

  Eigenmode::AcrossShares SolidMass::shares(const Vector<double> &displacement, const double whole) const
  {
    if (mirrored.empty())
      return {};
    Vector<double> opposite(displacement.size());
    for (unsigned int dof = 0; dof < opposite.size(); ++dof)
      opposite[dof] = 0.5 * (displacement[dof] + (component[dof] == 2 ? 1. : -1.) * displacement[mirrored[dof]]);
    const auto momentum = (*this)(opposite);
    double sideways     = 0.;
    for (unsigned int dof = 0; dof < opposite.size(); ++dof)
      sideways += component[dof] == 2 ? opposite[dof] * momentum[dof] : 0.;
    const double of_opposite = opposite * momentum;
    return { 1. - of_opposite / whole, (of_opposite - sideways) / whole, sideways / whole };
  }

  void SolidMass::find_cells(const SolidBody &body, const LeverInertia &inertia)
  {
    const auto &fe = body.dofs().get_fe();
    FEValues<3> values(body.cell_mapping(), fe, QGauss<3>(fe.degree + 1), update_values | update_JxW_values);
    std::map<std::vector<long>, const FullMatrix<double> *> known;
    for (const auto &cell : body.dofs().active_cell_iterators())
    {
      const auto material = cell->material_id();
      if (material == material_id::hub)
        continue;
      const auto [found, is_new] = known.try_emplace(likeness(cell));
      if (is_new)
      {
        values.reinit(cell);
        found->second = &masses.emplace_back(unit_mass(values));
      }
      cells.push_back({ found->second, inertia.densities.at(material) * body.body_properties().width, dofs_of_nodes(cell) });
    }
  }

  void SolidMass::add_tip(const SolidBody &body, const double tip_mass)
  {
    const auto faces  = faces_of_tip(body.dofs());
    const double area = total_measure<3>(faces);
    const auto &fe    = body.dofs().get_fe();
    FEFaceValues<3> values(body.cell_mapping(), fe, QGauss<2>(fe.degree + 1), update_values | update_JxW_values);
    for (const auto &[cell, f] : faces)
    {
      values.reinit(cell, f);
      cells.push_back({ &masses.emplace_back(unit_mass(values)), tip_mass / area, dofs_of_nodes(cell) });
    }
  }

  Vector<double> SolidMass::operator()(const Vector<double> &displacement) const
  {
    Vector<double> result(displacement.size());
    std::vector<std::array<double, 3>> of_cell;
    for (const auto &[mass, density, dofs] : cells)
    {
      of_cell.clear();
      for (const auto &of_node : dofs)
        of_cell.push_back({ { displacement[of_node[0]], displacement[of_node[1]], displacement[of_node[2]] } });
      for (unsigned int a = 0; a < dofs.size(); ++a)
      {
        std::array<double, 3> sum{};
        const double *const row = &(*mass)(a, 0);
        for (unsigned int b = 0; b < dofs.size(); ++b)
          for (unsigned int d = 0; d < 3; ++d)
            sum[d] += row[b] * of_cell[b][d];
        for (unsigned int d = 0; d < 3; ++d)
          result[dofs[a][d]] += density * sum[d];
      }
    }
    return result;
  }

  double SolidMass::sum_along(const unsigned int axis, const Vector<double> &of_dofs) const
  {
    double result = 0.;
    for (unsigned int dof = 0; dof < of_dofs.size(); ++dof)
      if (static_cast<unsigned int>(component[dof]) == axis)
        result += of_dofs[dof];
    return result;
  }
} // namespace sprag
