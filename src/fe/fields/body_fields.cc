#include "fe/fields/body_fields.h"

#include "fe/body/cell_elasticity.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_dgq.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/lac/full_matrix.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

namespace sprag
{
  using namespace dealii;

  namespace
  {
    bool touches_what_is_held(const ElasticBody<2> &body, const DoFHandler<2>::active_cell_iterator &cell)
    {
      for (const unsigned int v : cell->vertex_indices())
        if (body.is_held(static_cast<unsigned int>(cell->vertex_dof_index(v, 0))))
          return true;
      return false;
    }

    /// Where the dilatation is projected, so is the pressure [MPa]: at each point by itself it would swing within the cell.
    void set_stress(const BodyProperties &properties, const ElasticConstants &constants, const Tensor<2, 2> &gradient,
                    const std::optional<double> &pressure, NodalField &node)
    {
      const Lame lame    = plane_constants(constants, properties.plane);
      const bool linear  = properties.material == MaterialModel::linear;
      const auto F       = Tensor<2, 2>(unit_symmetric_tensor<2>()) + gradient;
      const double J     = linear ? 1. : determinant(F);
      const auto at_node = pressure ? stress_at_pressure<2>(properties.material, lame.mu, gradient, *pressure)
                                    : stress_of<2>(properties.material, lame, gradient);
      node.stress        = symmetrize(linear ? at_node.piola : at_node.piola * transpose(F) / J);
      if (pressure)
        node.out_of_plane = *pressure / J;
      else if (properties.material == MaterialModel::neo_hookean)
        node.out_of_plane = lame.lambda * std::log(J) / J;
      else if (properties.plane == PlaneState::strain && linear)
        node.out_of_plane = constants.poisson_ratio * trace(node.stress);
      else if (properties.plane == PlaneState::strain)
        node.out_of_plane = lame.lambda * (0.5 * (F.norm_square() - 2.)) / J; // by the trace of the strain
    }
    /// Values at places from those at points, by the polynomial through them: a row for each place.
    FullMatrix<double> extrapolation(const QGauss<1> &points, const Quadrature<2> &places)
    {
      const FE_DGQArbitraryNodes<2> polynomial(points);
      FullMatrix<double> result(places.size(), polynomial.n_dofs_per_cell());
      for (unsigned int i = 0; i < result.m(); ++i)
        for (unsigned int j = 0; j < result.n(); ++j)
          result(i, j) = polynomial.shape_value(j, places.point(i));
      return result;
    }

    /// Local degrees of freedom of the first displacement at places where the element has its nodes.
    std::vector<unsigned int> dofs_at(const FiniteElement<2> &fe, const Quadrature<2> &places)
    {
      std::vector<unsigned int> result;
      for (const auto &place : places.get_points())
        for (unsigned int i = 0; i < fe.n_dofs_per_cell(); ++i)
          if (fe.system_to_component_index(i).first == 0 && fe.unit_support_point(i).distance(place) < 1e-6)
            result.push_back(i);
      return result;
    }

    std::vector<Tensor<2, 2>> product(const FullMatrix<double> &matrix, const std::vector<Tensor<2, 2>> &values)
    {
      std::vector<Tensor<2, 2>> result(matrix.m());
      for (unsigned int i = 0; i < matrix.m(); ++i)
        for (unsigned int j = 0; j < matrix.n(); ++j)
          result[i] += matrix(i, j) * values[j];
      return result;
    }
  } // namespace

  double von_mises(const NodalField &node)
  {
    const double a = node.stress[0][0] - node.stress[1][1];
    const double b = node.stress[1][1] - node.out_of_plane;
    const double c = node.out_of_plane - node.stress[0][0];
    return std::sqrt(0.5 * (a * a + b * b + c * c) + 3. * node.stress[0][1] * node.stress[0][1]);
  }

  BodyFields::BodyFields(const ElasticBody<2> &of)
      : body(of)
      , places(QIterated<2>(QTrapezoid<1>(), body.body_properties().degree))
  {
    const unsigned int p = body.body_properties().degree;
    FEValues<2> values(body.cell_mapping(), body.dofs().get_fe(), places, update_quadrature_points);
    std::map<std::tuple<types::global_dof_index, types::material_id, bool>, unsigned int> numbers;
    const auto on_places = dofs_at(body.dofs().get_fe(), places);
    std::vector<types::global_dof_index> dofs(body.dofs().get_fe().n_dofs_per_cell());
    for (const auto &cell : body.dofs().active_cell_iterators())
    {
      values.reinit(cell);
      cell->get_dof_indices(dofs);
      const bool at_hub = cell->material_id() == material_id::hub || touches_what_is_held(body, cell);
      for (const unsigned int dof : on_places)
        shared.push_back(numbers.emplace(std::tuple(dofs[dof], cell->material_id(), at_hub), numbers.size()).first->second);
      const auto first = static_cast<unsigned int>(all_nodes.size());
      for (const auto &point : values.get_quadrature_points())
        all_nodes.push_back({ point, cell->material_id(), at_hub });
      for (unsigned int j = 0; j < p; ++j)
        for (unsigned int i = 0; i < p; ++i)
        {
          const unsigned int corner = first + j * (p + 1) + i;
          quads.insert(quads.end(), { corner, corner + 1, corner + p + 2, corner + p + 1 });
        }
    }
    n_shared = static_cast<unsigned int>(numbers.size());
  }

  std::vector<NodalField> BodyFields::at(const Vector<double> &displacement) const
  {
    const auto &properties = body.body_properties();
    const auto &fe         = body.dofs().get_fe();
    FEValues<2> values(body.cell_mapping(), fe, places, update_values);
    const QGauss<1> points(std::max(2u, properties.degree));
    FEValues<2> at_points(body.cell_mapping(), fe, QGauss<2>(points.size()), update_gradients);
    const auto to_nodes = extrapolation(points, places);
    CellElasticity<2> elasticity(body.cell_mapping(), fe, properties);
    Vector<double> of_cell(fe.n_dofs_per_cell());
    const FEValuesExtractors::Vector vector(0);
    std::vector<Tensor<1, 2>> displacements(places.size());
    std::vector<Tensor<2, 2>> gradients_at_points(at_points.n_quadrature_points);
    std::vector<NodalField> result;
    result.reserve(all_nodes.size());
    for (const auto &cell : body.dofs().active_cell_iterators())
    {
      values.reinit(cell);
      values[vector].get_function_values(displacement, displacements);
      at_points.reinit(cell);
      at_points[vector].get_function_gradients(displacement, gradients_at_points);
      const auto gradients    = product(to_nodes, gradients_at_points);
      const auto material     = cell->material_id();
      const bool is_elastic   = material != material_id::hub;
      const bool is_projected = is_elastic && is_nearly_incompressible(properties, material);
      if (is_projected)
      {
        cell->get_dof_values(displacement, of_cell);
        elasticity.reinit(cell, of_cell);
      }
      for (unsigned int q = 0; q < places.size(); ++q)
      {
        NodalField node{ displacements[q], {}, 0. };
        std::optional<double> pressure;
        if (is_projected)
          pressure = plane_constants(properties.constants.at(material), properties.plane).lambda *
                     elasticity.dilatation()(all_nodes[result.size()].position);
        if (is_elastic)
          set_stress(properties, properties.constants.at(material), gradients[q], pressure, node);
        result.push_back(node);
      }
    }
    average(result);
    return result;
  }

  void BodyFields::average(std::vector<NodalField> &nodal) const
  {
    std::vector<NodalField> sums(n_shared);
    std::vector<unsigned int> cells(n_shared, 0);
    for (std::size_t i = 0; i < nodal.size(); ++i)
    {
      sums[shared[i]].stress += nodal[i].stress;
      sums[shared[i]].out_of_plane += nodal[i].out_of_plane;
      ++cells[shared[i]];
    }
    for (std::size_t i = 0; i < nodal.size(); ++i)
    {
      nodal[i].stress       = sums[shared[i]].stress / cells[shared[i]];
      nodal[i].out_of_plane = sums[shared[i]].out_of_plane / cells[shared[i]];
    }
  }
} // namespace sprag
