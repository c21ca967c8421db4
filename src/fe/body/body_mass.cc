// SPDX-License-Identifier: GPL-3.0-only
#include "fe/body/body_mass.h"

#include "base/errors.h"
#include "base/text.h"
#include "fe/body/cell_stiffness.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_values.h>

namespace sprag
{
  using namespace dealii;

  namespace
  {
    /// Mass of unit density, between the scalar shape functions of a cell.
    template <int dim>
    FullMatrix<double> unit_mass(const FEValuesBase<dim> &values)
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
    template <int dim>
    std::vector<std::array<unsigned int, dim>> node_dofs(const typename DoFHandler<dim>::active_cell_iterator &cell)
    {
      const auto &fe     = cell->get_fe();
      const auto indices = cell_dofs(cell);
      std::vector<std::array<unsigned int, dim>> result(fe.base_element(0).n_dofs_per_cell());
      for (unsigned int a = 0; a < result.size(); ++a)
        for (unsigned int d = 0; d < dim; ++d)
          result[a][d] = static_cast<unsigned int>(indices[fe.component_to_system_index(d, a)]);
      return result;
    }

    /// Returns by what densities are scaled; `cell_inertia` and `added` are moments of inertia before that [t mm^2].
    double density_scaling(const LeverInertia &inertia, const double cell_inertia, const double added)
    {
      if (inertia.source != InertiaSource::scaled)
        return 1.;
      if (inertia.moment_of_inertia <= added)
        throw InputError("tip mass, hub and leaf spring alone have a moment of inertia of " + rounded_text(added) +
                         " t mm^2 about the pivot: Lever/Moment of inertia = " + rounded_text(inertia.moment_of_inertia) +
                         " must be larger");
      return (inertia.moment_of_inertia - added) / cell_inertia;
    }
  } // namespace

  template <int dim>
  std::vector<int> turning_axes(const ElasticBody<dim> &body)
  {
    std::vector<int> result(body.n_dofs(), -1);
    const auto &fe = body.dofs().get_fe();
    for (const auto &cell : body.dofs().active_cell_iterators())
      if (material_id::turns(cell->material_id()))
      {
        const auto indices = cell_dofs(cell);
        for (unsigned int i = 0; i < indices.size(); ++i)
          result[indices[i]] = static_cast<int>(fe.system_to_component_index(i).first);
      }
    return result;
  }

  template <int dim>
  Vector<double> rotation_arms(const ElasticBody<dim> &body)
  {
    std::vector<Point<dim>> places(body.n_dofs());
    DoFTools::map_dofs_to_support_points(body.cell_mapping(), body.dofs(), places);
    const auto axes = turning_axes(body);
    Vector<double> result(body.n_dofs());
    for (unsigned int dof = 0; dof < result.size(); ++dof)
      result[dof] = axes[dof] == 0 ? -places[dof][1] : axes[dof] == 1 ? places[dof][0] : 0.;
    return result;
  }

  template <int dim>
  BodyMass<dim>::BodyMass(const ElasticBody<dim> &body, const LeverInertia &inertia)
      : BodyMass(body, inertia, inertia.tip_mass > 0. ? end_face(body.dofs()) : CellFaces<dim>())
  {
  }

  template <int dim>
  BodyMass<dim>::BodyMass(const ElasticBody<dim> &body, const LeverInertia &inertia, const CellFaces<dim> &tip)
      : arms(rotation_arms(body))
      , hub(inertia.hub + inertia.leaf.inertia)
      , axes(turning_axes(body))
  {
    const auto body_inertia = [&] { return arms * (*this)(arms); };
    add_tip(body, inertia.tip_mass, tip);
    const double added   = body_inertia() + hub;
    const auto tip_begin = all_cells.size();
    add_cells(body, inertia);
    const double cell_inertia = body_inertia() - (added - hub);
    density_factor            = density_scaling(inertia, cell_inertia, added);
    moment_of_inertia         = density_factor * cell_inertia + added;
    for (std::size_t i = tip_begin; i < all_cells.size(); ++i)
      all_cells[i].density *= turns(all_cells[i]) ? density_factor : 1.;
    total_mass = sum_along(0, (*this)(translation(0))) + inertia.leaf.mass;
  }

  template <int dim>
  void BodyMass<dim>::add_cells(const ElasticBody<dim> &body, const LeverInertia &inertia)
  {
    const auto &fe         = body.dofs().get_fe();
    const auto &properties = body.body_properties();
    FEValues<dim> values(body.cell_mapping(), fe, QGauss<dim>(fe.degree + 1), update_values | update_JxW_values);
    std::map<std::vector<long>, const FullMatrix<double> *> known;
    for (const auto &cell : body.dofs().active_cell_iterators())
    {
      const auto material = cell->material_id();
      if (material == material_id::hub)
        continue;
      auto &mass_matrix = known[cell_shape<dim>(cell)];
      if (mass_matrix == nullptr)
      {
        values.reinit(cell);
        mass_matrix = &masses.emplace_back(unit_mass(values));
      }
      all_cells.push_back(
          { mass_matrix, inertia.densities.at(material) * properties.material_width(material), node_dofs<dim>(cell) });
    }
  }

  template <int dim>
  void BodyMass<dim>::add_tip(const ElasticBody<dim> &body, const double tip_mass, const CellFaces<dim> &tip)
  {
    if (tip_mass > 0. && tip.empty())
      throw InputError("the mesh has no straight end face across the lever to carry Lever/Tip mass");
    const double area = total_measure<dim>(tip);
    const auto &fe    = body.dofs().get_fe();
    FEFaceValues<dim> values(body.cell_mapping(), fe, QGauss<dim - 1>(fe.degree + 1), update_values | update_JxW_values);
    for (const auto &[cell, f] : tip)
    {
      values.reinit(cell, f);
      all_cells.push_back({ &masses.emplace_back(unit_mass(values)), tip_mass / area, node_dofs<dim>(cell) });
    }
  }

  template <int dim>
  Vector<double> BodyMass<dim>::operator()(const Vector<double> &displacement) const
  {
    Vector<double> result(displacement.size());
    std::vector<std::array<double, dim>> cell_displacement;
    for (const auto &[mass, density, dofs] : all_cells)
    {
      cell_displacement.resize(dofs.size());
      for (unsigned int a = 0; a < dofs.size(); ++a)
        for (unsigned int d = 0; d < dim; ++d)
          cell_displacement[a][d] = displacement[dofs[a][d]];
      for (unsigned int a = 0; a < dofs.size(); ++a)
      {
        std::array<double, dim> sum{};
        const double *const row = &(*mass)(a, 0);
        for (unsigned int b = 0; b < dofs.size(); ++b)
          for (unsigned int d = 0; d < dim; ++d)
            sum[d] += row[b] * cell_displacement[b][d];
        for (unsigned int d = 0; d < dim; ++d)
          result[dofs[a][d]] += density * sum[d];
      }
    }
    return result;
  }

  template Vector<double> rotation_arms(const ElasticBody<2> &);
  template class BodyMass<2>;
  template class BodyMass<3>;
} // namespace sprag
