// SPDX-License-Identifier: GPL-3.0-only
#include "fe/body/elastic_body.h"

#include "base/ranges.h"
#include "fe/algebra/nested_dissection.h"
#include "fe/body/cell_elasticity.h"
#include "fe/body/end_face.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/numerics/vector_tools.h>

#include <algorithm>
#include <cmath>

namespace sprag
{
  using namespace dealii;

  template <int dim>
  ElasticBody<dim>::ElasticBody(const Triangulation<dim> &triangulation, BodyProperties body_properties,
                                const Constrain &constrain)
      : properties(std::move(body_properties))
      , fe(FE_Q<dim>(properties.degree), dim)
      , mapping(properties.curved ? properties.degree : 1)
      , dof_handler(triangulation)
  {
    dof_handler.distribute_dofs(fe);
    find_constraints(constrain);
    face                   = find_friction_face(mapping, dof_handler, constraints, properties, boundary_id::friction_face);
    cylinder_friction_face = find_friction_face(mapping, dof_handler, constraints, properties, boundary_id::cylinder_face);
    if constexpr (dim == 2)
      springs = find_connectors(*this, properties.connectors);
  }

  template <int dim>
  void ElasticBody<dim>::find_constraints(const Constrain &constrain)
  {
    const Functions::ZeroFunction<dim> none(dim);
    for (const auto held_boundary : { boundary_id::hub, boundary_id::core })
      VectorTools::interpolate_boundary_values(dof_handler, held_boundary, none, constraints);
    if (dim == 3)
      VectorTools::interpolate_boundary_values(dof_handler, boundary_id::symmetry, none, constraints,
                                               fe.component_mask(FEValuesExtractors::Scalar(dim - 1)));
    for (const auto &cell : dof_handler.active_cell_iterators())
      if (cell->material_id() == material_id::hub)
        for (const auto index : cell_dofs(cell))
          constraints.add_line(index);
    if (constrain)
      constrain(dof_handler, constraints);
    constraints.close();
  }

  template <int dim>
  std::vector<Connector> ElasticBody<dim>::sensors() const
  {
    return filtered(springs, [](const Connector &spring) { return spring.type == ConnectorType::sensor; });
  }

  template <int dim>
  void ElasticBody<dim>::reinit(PETScWrappers::SparseMatrix &matrix) const
  {
    DynamicSparsityPattern pattern(n_dofs(), n_dofs());
    DoFTools::make_sparsity_pattern(dof_handler, pattern, constraints, true);
    for (const auto &spring : springs)
      for (const auto &i : spring.row)
        for (const auto &j : spring.row)
          pattern.add(i.first, j.first);
    matrix.reinit(pattern);
  }

  template <int dim>
  void ElasticBody<dim>::assemble(const Vector<double> &displacement, PETScWrappers::SparseMatrix &matrix,
                                  Vector<double> &forces) const
  {
    CellElasticity<dim> elasticity(mapping, fe, properties);
    const unsigned int n = fe.n_dofs_per_cell();
    FullMatrix<double> cell_matrix(n, n);
    Vector<double> cell_forces(n);
    Vector<double> cell_displacement(n);
    for (const auto &cell : dof_handler.active_cell_iterators())
    {
      if (cell->material_id() == material_id::hub)
        continue;
      cell->get_dof_values(displacement, cell_displacement);
      elasticity.reinit(cell, cell_displacement);
      elasticity.assemble(cell_matrix, cell_forces);
      constraints.distribute_local_to_global(cell_matrix, cell_forces, cell_dofs(cell), matrix, forces);
    }
    for (const auto &spring : springs)
    {
      const double force = spring.stiffness * spring.compression(displacement);
      for (const auto &[i, weight_i] : spring.row)
      {
        forces[i] += weight_i * force;
        for (const auto &[j, weight_j] : spring.row)
          matrix.add(i, j, spring.stiffness * weight_i * weight_j);
      }
    }
    for (const auto &line : constraints.get_lines())
    {
      matrix.add(line.index, line.index, 1.);
      forces[line.index] = 0.;
    }
    matrix.compress(VectorOperation::add);
  }

  template <int dim>
  std::shared_ptr<const Mumps> ElasticBody<dim>::factorised() const
  {
    const auto factors = std::make_shared<Mumps>(MatrixKind::positive_definite);
    PETScWrappers::SparseMatrix stiffness;
    Vector<double> forces(n_dofs());
    reinit(stiffness);
    assemble(Vector<double>(n_dofs()), stiffness, forces);
    std::vector<int> order;
    if constexpr (dim == 2)
    {
      std::vector<Point<2>> places(n_dofs());
      DoFTools::map_dofs_to_support_points(mapping, dof_handler, places);
      order = nested_dissection(MatrixRows(stiffness), places);
    }
    factors->factorise(stiffness, std::move(order));
    return factors;
  }

  template <int dim>
  double ElasticBody<dim>::energy(const Vector<double> &displacement) const
  {
    CellElasticity<dim> elasticity(mapping, fe, properties);
    Vector<double> cell_displacement(fe.n_dofs_per_cell());
    double sum = 0.;
    for (const auto &spring : springs)
      sum += 0.5 * spring.stiffness * std::pow(spring.compression(displacement), 2);
    for (const auto &cell : dof_handler.active_cell_iterators())
      if (cell->material_id() != material_id::hub)
      {
        cell->get_dof_values(displacement, cell_displacement);
        elasticity.reinit(cell, cell_displacement);
        sum += elasticity.energy();
      }
    return sum;
  }

  template <int dim>
  std::array<double, 2> ElasticBody<dim>::mass_and_inertia(const double density) const
  {
    FEValues<dim> values(mapping, fe, QGauss<dim>(2), update_quadrature_points | update_JxW_values);
    std::array<double, 2> result{};
    for (const auto &cell : dof_handler.active_cell_iterators())
    {
      values.reinit(cell);
      for (const unsigned int q : values.quadrature_point_indices())
      {
        const double mass = density * values.JxW(q) * properties.material_width(cell->material_id());
        result[0] += mass;
        result[1] += mass * (std::pow(values.quadrature_point(q)[0], 2) + std::pow(values.quadrature_point(q)[1], 2));
      }
    }
    return result;
  }

  template <int dim>
  std::vector<double> ElasticBody<dim>::sensor_forces(const Vector<double> &displacement) const
  {
    return mapped(sensors(), [&](const auto &sensor) { return sensor.stiffness * sensor.compression(displacement); });
  }

  template class ElasticBody<2>;
  template class ElasticBody<3>;
} // namespace sprag
