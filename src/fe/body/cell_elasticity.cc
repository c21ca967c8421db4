// SPDX-License-Identifier: GPL-3.0-only
#include "fe/body/cell_elasticity.h"

#include <deal.II/base/quadrature_lib.h>

#include <cmath>

namespace sprag
{
  using namespace dealii;

  namespace
  {
    template <int dim>
    Point<dim> cell_centre(const FEValues<dim> &values)
    {
      Point<dim> sum;
      double volume = 0.;
      for (const unsigned int q : values.quadrature_point_indices())
      {
        sum += values.JxW(q) * values.quadrature_point(q);
        volume += values.JxW(q);
      }
      return sum / volume;
    }

    double product(const std::vector<double> &a, const std::vector<double> &b, const std::vector<double> &weights)
    {
      double sum = 0.;
      for (std::size_t q = 0; q < weights.size(); ++q)
        sum += weights[q] * a[q] * b[q];
      return sum;
    }
  } // namespace

  /// Makes the functions orthogonal after Gram and Schmidt. The first coordinates have no part in the constant, as they are
  /// counted from the centre.
  template <int dim>
  void DilatationSpace<dim>::reinit(const FEValues<dim> &values, const unsigned int degree)
  {
    const auto &weights = values.get_JxW_values();
    functions.assign(degree == 0 ? 1 : dim + 1, { cell_centre(values), 0., {} });
    at_points.assign(functions.size(), std::vector<double>(weights.size()));
    for (unsigned int a = 0; a < functions.size(); ++a)
    {
      auto &function = functions[a];
      auto &at_point = at_points[a];
      if (a == 0)
        function.constant = 1.;
      else
        function.slope[a - 1] = 1.;
      const auto evaluate = [&]
      {
        for (const unsigned int q : values.quadrature_point_indices())
          at_point[q] = function(values.quadrature_point(q));
      };
      evaluate();
      for (unsigned int b = 0; b < a; ++b)
      {
        const double share = product(at_point, at_points[b], weights);
        function.constant -= share * functions[b].constant;
        function.slope -= share * functions[b].slope;
      }
      evaluate();
      const double size = std::sqrt(product(at_point, at_point, weights));
      function.constant /= size;
      function.slope /= size;
      for (double &value : at_point)
        value /= size;
    }
  }

  template <int dim>
  LinearPolynomial<dim> DilatationSpace<dim>::combined(const std::vector<double> &factors) const
  {
    LinearPolynomial<dim> sum{ functions.front().centre, 0., {} };
    for (std::size_t a = 0; a < functions.size(); ++a)
    {
      sum.constant += factors[a] * functions[a].constant;
      sum.slope += factors[a] * functions[a].slope;
    }
    return sum;
  }

  template class DilatationSpace<2>;
  template class DilatationSpace<3>;

  bool is_nearly_incompressible(const BodyProperties &properties, const types::material_id id)
  {
    return properties.plane_state(id) == PlaneState::strain && properties.material != MaterialModel::st_venant_kirchhoff &&
           properties.constants.at(id).poisson_ratio > 0.4;
  }

  template <int dim>
  CellElasticity<dim>::CellElasticity(const Mapping<dim> &mapping, const FiniteElement<dim> &fe,
                                      const BodyProperties &body_properties)
      : properties(body_properties)
      , values(std::make_unique<FEValues<dim>>(mapping, fe, QGauss<dim>(properties.degree + 1),
                                               update_gradients | update_quadrature_points | update_JxW_values))
      , displacement_gradients(values->n_quadrature_points)
  {
  }

  template <int dim>
  CellElasticity<dim>::~CellElasticity() = default;

  template <int dim>
  void CellElasticity<dim>::reinit(const Cell &cell, const Vector<double> &displacement)
  {
    values->reinit(cell);
    const auto material = cell->material_id();
    constants           = plane_constants(properties.constants.at(material), properties.plane_state(material));
    width               = properties.material_width(material);
    const auto &fe      = values->get_fe();
    for (const unsigned int q : values->quadrature_point_indices())
    {
      auto &gradient = displacement_gradients[q] = Tensor<2, dim>();
      for (unsigned int i = 0; i < fe.n_dofs_per_cell(); ++i)
        gradient[fe.system_to_component_index(i).first] += displacement[i] * values->shape_grad(i, q);
    }
    projects = is_nearly_incompressible(properties, material);
    if (projects)
      project();
  }

  template <int dim>
  void CellElasticity<dim>::project()
  {
    const auto &fe       = values->get_fe();
    const unsigned int n = fe.n_dofs_per_cell();
    space.reinit(*values, properties.degree - 1);
    projected.assign(space.size(), 0.);
    changes.reinit(space.size(), n);
    for (const unsigned int q : values->quadrature_point_indices())
    {
      const auto at_point = sprag::dilatation<dim>(properties.material, displacement_gradients[q]);
      for (unsigned int a = 0; a < space.size(); ++a)
      {
        const double weight = space.value(a, q) * values->JxW(q);
        projected[a] += weight * at_point.value;
        for (unsigned int i = 0; i < n; ++i)
          changes(a, i) += weight * (at_point.derivative[fe.system_to_component_index(i).first] * values->shape_grad(i, q));
      }
    }
  }

  /// The pressure is the projected one where it is projected.
  template <int dim>
  Stress<dim> CellElasticity<dim>::stress_at(const unsigned int q) const
  {
    if (!projects)
      return compute_stress<dim>(properties.material, constants, displacement_gradients[q]);
    double theta = 0.;
    for (unsigned int a = 0; a < space.size(); ++a)
      theta += projected[a] * space.value(a, q);
    return stress_at_pressure<dim>(properties.material, constants.mu, displacement_gradients[q], constants.lambda * theta);
  }

  template <int dim>
  void CellElasticity<dim>::assemble(FullMatrix<double> &stiffness, Vector<double> &forces) const
  {
    const auto &fe       = values->get_fe();
    const unsigned int n = fe.n_dofs_per_cell();
    std::vector<Tensor<1, dim>> gradients(n);
    stiffness = 0.;
    forces    = 0.;
    for (const unsigned int q : values->quadrature_point_indices())
    {
      for (unsigned int i = 0; i < n; ++i)
        gradients[i] = values->shape_grad(i, q);
      const double volume = values->JxW(q) * width;
      const auto at_point = stress_at(q);
      for (unsigned int j = 0; j < n; ++j)
      {
        const unsigned int component_j = fe.system_to_component_index(j).first;
        forces[j] += volume * (at_point.piola[component_j] * gradients[j]);
        Tensor<1, dim * dim> d_piola;
        for (unsigned int a = 0; a < dim * dim; ++a)
          for (unsigned int d = 0; d < dim; ++d)
            d_piola[a] += volume * at_point.tangent[a][component_j * dim + d] * gradients[j][d];
        for (unsigned int i = 0; i < n; ++i)
        {
          const unsigned int row = fe.system_to_component_index(i).first * dim;
          for (unsigned int d = 0; d < dim; ++d)
            stiffness(i, j) += gradients[i][d] * d_piola[row + d];
        }
      }
    }
    if (projects)
      for (unsigned int a = 0; a < space.size(); ++a)
        for (unsigned int i = 0; i < n; ++i)
          for (unsigned int j = 0; j < n; ++j)
            stiffness(i, j) += width * constants.lambda * changes(a, i) * changes(a, j);
  }

  template <int dim>
  void CellElasticity<dim>::find_forces(Vector<double> &forces) const
  {
    const auto &fe = values->get_fe();
    forces         = 0.;
    for (const unsigned int q : values->quadrature_point_indices())
    {
      const auto piola = values->JxW(q) * width * stress_at(q).piola;
      for (unsigned int i = 0; i < fe.n_dofs_per_cell(); ++i)
        forces[i] += piola[fe.system_to_component_index(i).first] * values->shape_grad(i, q);
    }
  }

  template <int dim>
  double CellElasticity<dim>::energy() const
  {
    const Lame at_points{ projects ? 0. : constants.lambda, constants.mu };
    double sum = 0.;
    for (const unsigned int q : values->quadrature_point_indices())
      sum += energy_density<dim>(properties.material, at_points, displacement_gradients[q]) * values->JxW(q) * width;
    if (projects)
      for (const double theta : projected)
        sum += 0.5 * constants.lambda * theta * theta * width;
    return sum;
  }

  template class CellElasticity<2>;
  template class CellElasticity<3>;
} // namespace sprag
