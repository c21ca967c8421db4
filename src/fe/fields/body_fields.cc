// SPDX-License-Identifier: GPL-3.0-only
#include "fe/fields/body_fields.h"

#include "fe/body/cell_elasticity.h"
#include "fe/body/end_face.h"
#include "fe/contact/face_parts.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_dgq.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/vector.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>

namespace sprag
{
  using namespace dealii;

  FieldFace::FieldFace(const FrictionFace<2> &face)
      : points_per_cell(2)
  {
    std::vector<unsigned int> itself(face.points.size());
    std::iota(itself.begin(), itself.end(), 0u);
    for (unsigned int q = 0; q < face.points.size(); ++q)
    {
      points.emplace_back(face.points[q].position[0], face.points[q].position[1], 0.);
      if (q > 0)
        cells.insert(cells.end(), { q - 1, q });
    }
    read(face, itself, std::vector<double>(itself.size(), 1.));
  }

  FieldFace::FieldFace(const FrictionFace<3> &face)
      : points_per_cell(4)
  {
    const auto parts        = face_parts(face);
    const auto &part_points = parts.points;
    const double height     = face.points.empty() ? 0. : face.points.front().position[1];
    for (std::size_t i = 0; i < part_points.xi.size(); ++i)
      points.emplace_back(part_points.xi[i], height, part_points.zeta[i]);
    std::vector<double> share;
    for (std::size_t q = 0; q < face.points.size(); ++q)
      share.push_back(face.points[q].weight / part_points.weight[parts.point_parts[q]]);
    read(face, parts.point_parts, share);
    join_lines();
  }

  template <int dim>
  void FieldFace::read(const FrictionFace<dim> &face, const std::vector<unsigned int> &indices, const std::vector<double> &share)
  {
    for (const auto &node : face.nodes)
    {
      dofs.push_back({ { node.dofs[0], node.dofs[1], numbers::invalid_unsigned_int } });
      if constexpr (dim == 3)
        dofs.back()[2] = node.dofs[2];
    }
    std::vector<std::map<unsigned int, double>> sums(points.size());
    for (const auto &element : face.elements)
      for (unsigned int q = element.begin; q < element.end; ++q)
        for (unsigned int a = 0; a < element.n_nodes; ++a)
          sums[indices[q]][element.nodes[a]] += share[q] * face.points[q].shapes[a];
    for (const auto &dof_weights : sums)
      movers.emplace_back(dof_weights.begin(), dof_weights.end());
  }

  /// Between lines of points with the same zeta, which all have the same xi.
  void FieldFace::join_lines()
  {
    const auto lines = lines_along(points);
    if (!lines.empty())
      first_line = lines.front();
    for (std::size_t k = 1; k < lines.size(); ++k)
      for (std::size_t i = 1; i < std::min(lines[k].size(), lines[k - 1].size()); ++i)
        cells.insert(cells.end(), { lines[k - 1][i - 1], lines[k - 1][i], lines[k][i], lines[k][i - 1] });
  }

  Tensor<1, 3> FieldFace::moved(const unsigned int point, const Vector<double> &displacement) const
  {
    Tensor<1, 3> result;
    for (const auto &[node, shape] : movers[point])
      for (unsigned int d = 0; d < (points_per_cell == 4 ? 3u : 2u); ++d)
        result[d] += shape * displacement[dofs[node][d]];
    return result;
  }

  namespace
  {
    constexpr unsigned int none = numbers::invalid_unsigned_int;

    template <class AnyBody, class Cell>
    bool touches_what_is_held(const AnyBody &body, const Cell &cell)
    {
      const auto corners = cell->vertex_indices();
      return std::any_of(corners.begin(), corners.end(),
                         [&](const unsigned int v)
                         { return body.is_held(static_cast<unsigned int>(cell->vertex_dof_index(v, 0))); });
    }

    /// The normal stress out of the plane [MPa].
    double out_of_plane(const BodyProperties &properties, const types::material_id material, const Tensor<2, 2> &F,
                        const SymmetricTensor<2, 2> &in_plane, const std::optional<double> &pressure)
    {
      const auto &constants = properties.constants.at(material);
      const auto plane      = properties.plane_state(material);
      const Lame lame       = plane_constants(constants, plane);
      const bool linear     = properties.material == MaterialModel::linear;
      const double J        = linear ? 1. : determinant(F);
      if (pressure)
        return *pressure / J;
      if (properties.material == MaterialModel::neo_hookean)
        return lame.lambda * std::log(J) / J;
      if (plane == PlaneState::stress)
        return 0.;
      if (linear)
        return constants.poisson_ratio * trace(in_plane);
      return lame.lambda * (0.5 * (F.norm_square() - 2.)) / J; // by the trace of the strain
    }

    /// Stress at a point [MPa]. If the dilatation is projected, the pressure is too: at each point by itself it would swing
    /// within the element.
    template <int dim>
    SymmetricTensor<2, 3> stress_at(const BodyProperties &properties, const types::material_id material,
                                    const Tensor<2, dim> &gradient, const std::optional<double> &pressure)
    {
      const Lame lame   = plane_constants(properties.constants.at(material), properties.plane_state(material));
      const bool linear = properties.material == MaterialModel::linear;
      const auto F      = Tensor<2, dim>(unit_symmetric_tensor<dim>()) + gradient;
      const auto at     = pressure ? stress_at_pressure<dim>(properties.material, lame.mu, gradient, *pressure)
                                   : compute_stress<dim>(properties.material, lame, gradient);
      const auto cauchy = symmetrize(linear ? at.piola : at.piola * transpose(F) / determinant(F));
      SymmetricTensor<2, 3> result;
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int j = i; j < dim; ++j)
          result[i][j] = cauchy[i][j];
      if constexpr (dim == 2)
        result[2][2] = out_of_plane(properties, material, F, cauchy, pressure);
      return result;
    }

    /// Values at places from those at points, by the polynomial through them: a row for each place.
    template <int dim>
    FullMatrix<double> extrapolation(const QGauss<1> &points, const Quadrature<dim> &places)
    {
      const FE_DGQArbitraryNodes<dim> polynomial(points);
      FullMatrix<double> result(places.size(), polynomial.n_dofs_per_cell());
      for (unsigned int i = 0; i < result.m(); ++i)
        for (unsigned int j = 0; j < result.n(); ++j)
          result(i, j) = polynomial.shape_value(j, places.point(i));
      return result;
    }

    template <int dim>
    std::vector<Tensor<2, dim>> product(const FullMatrix<double> &matrix, const std::vector<Tensor<2, dim>> &values)
    {
      std::vector<Tensor<2, dim>> result(matrix.m());
      for (unsigned int i = 0; i < matrix.m(); ++i)
        for (unsigned int j = 0; j < matrix.n(); ++j)
          result[i] += matrix(i, j) * values[j];
      return result;
    }

    /// Places of the nodes in the unit element, along the first axis, then the second, then the third.
    template <int dim>
    Quadrature<dim> output_quadrature(const BodyProperties &properties)
    {
      return QIterated<dim>(QTrapezoid<1>(), properties.degree);
    }

    /// Local degrees of freedom of the displacements at places where the element has its nodes.
    template <int dim>
    std::vector<std::array<unsigned int, dim>> dofs_at(const FiniteElement<dim> &fe, const Quadrature<dim> &places)
    {
      std::vector<std::array<unsigned int, dim>> result(places.size());
      for (unsigned int k = 0; k < places.size(); ++k)
        for (unsigned int i = 0; i < fe.n_dofs_per_cell(); ++i)
          if (fe.unit_support_point(i).distance(places.point(k)) < 1e-6)
            result[k][fe.system_to_component_index(i).first] = i;
      return result;
    }

    /// In the order of XDMF's quadrilaterals and hexahedra.
    std::vector<unsigned int> cell_corners(const unsigned int p, const bool in_space)
    {
      std::vector<unsigned int> result;
      const unsigned int row = p + 1, layer = row * row;
      for (unsigned int k = 0; k < (in_space ? p : 1); ++k)
        for (unsigned int j = 0; j < p; ++j)
          for (unsigned int i = 0; i < p; ++i)
            for (unsigned int first = k * layer + j * row + i, side = 0; side < (in_space ? 2u : 1u); ++side, first += layer)
              result.insert(result.end(), { first, first + 1, first + row + 1, first + row });
      return result;
    }

    /// The stress of a body's elements, which the ranks take by turns, at their nodes.
    template <int dim>
    void add_stresses(const DoFHandler<dim> &dofs, const Mapping<dim> &mapping, const BodyProperties &properties,
                      const Vector<double> &displacement, const std::vector<unsigned int> &element_nodes, const MPI_Comm ranks,
                      std::vector<SymmetricTensor<2, 3>> &sums)
    {
      const unsigned int own = Utilities::MPI::this_mpi_process(ranks), n_ranks = Utilities::MPI::n_mpi_processes(ranks);
      const auto places = output_quadrature<dim>(properties);
      const QGauss<1> points(std::max(2u, properties.degree));
      FEValues<dim> at_points(mapping, dofs.get_fe(), QGauss<dim>(points.size()), update_gradients);
      const auto to_nodes = extrapolation<dim>(points, places);
      CellElasticity<dim> elasticity(mapping, dofs.get_fe(), properties);
      Vector<double> element_displacement(dofs.get_fe().n_dofs_per_cell());
      const FEValuesExtractors::Vector vector(0);
      std::vector<Tensor<2, dim>> gradients_at_points(at_points.n_quadrature_points);
      FEValues<dim> at_places(mapping, dofs.get_fe(), places, update_quadrature_points);
      unsigned int element = 0;
      for (const auto &cell : dofs.active_cell_iterators())
      {
        const unsigned int *const nodes = &element_nodes[places.size() * element];
        const auto material             = cell->material_id();
        if (element++ % n_ranks != own || material == material_id::hub)
          continue;
        at_points.reinit(cell);
        at_points[vector].get_function_gradients(displacement, gradients_at_points);
        const auto gradients    = product(to_nodes, gradients_at_points);
        const Lame lame         = plane_constants(properties.constants.at(material), properties.plane_state(material));
        const bool is_projected = is_nearly_incompressible(properties, material);
        if (is_projected)
        {
          cell->get_dof_values(displacement, element_displacement);
          elasticity.reinit(cell, element_displacement);
          at_places.reinit(cell);
        }
        for (unsigned int q = 0; q < places.size(); ++q)
        {
          std::optional<double> pressure;
          if (is_projected)
            pressure = lame.lambda * elasticity.dilatation()(at_places.quadrature_point(q));
          sums[nodes[q]] += stress_at<dim>(properties, material, gradients[q], pressure);
        }
      }
    }
  } // namespace

  double von_mises(const NodalField &node)
  {
    const auto &s  = node.stress;
    const double a = s[0][0] - s[1][1], b = s[1][1] - s[2][2], c = s[2][2] - s[0][0];
    const double shear = s[0][1] * s[0][1] + s[1][2] * s[1][2] + s[2][0] * s[2][0];
    return std::sqrt(0.5 * (a * a + b * b + c * c) + 3. * shear);
  }

  BodyFields::BodyFields(const ElasticBody<2> &body)
      : is_in_space(false)
      , face(body.friction_face())
  {
    read<2>(body);
  }

  BodyFields::BodyFields(const SolidBody &body)
      : BodyFields(body, body.friction_face())
  {
  }

  BodyFields::BodyFields(const SolidBody &body, const FrictionFace<3> &displayed)
      : is_in_space(true)
      , is_half(body.is_half())
      , face(displayed)
      , calls(&body.calls())
      , ranks(calls->ranks)
  {
    read<3>(body);
  }

  template <int dim, class AnyBody>
  void BodyFields::read(const AnyBody &body)
  {
    const auto &fe    = body.dofs().get_fe();
    const auto places = output_quadrature<dim>(body.body_properties());
    FEValues<dim> values(body.cell_mapping(), fe, places, update_quadrature_points);
    std::map<std::pair<types::material_id, bool>, std::vector<unsigned int>> numbers; // by the first degree of freedom
    const auto on_places = dofs_at<dim>(fe, places);
    for (const auto &cell : body.dofs().active_cell_iterators())
    {
      values.reinit(cell);
      const auto element_dofs = cell_dofs(cell);
      const auto part         = cell->material_id();
      const bool at_hub       = part == material_id::hub || touches_what_is_held(body, cell);
      auto &number            = numbers[{ part, at_hub }];
      number.resize(body.n_dofs(), none);
      for (unsigned int q = 0; q < places.size(); ++q)
      {
        auto &node        = number[element_dofs[on_places[q][0]]];
        const bool is_new = node == none;
        if (is_new)
          node = static_cast<unsigned int>(nodes.size());
        elements.push_back(node);
        if (!is_new)
          continue;
        Point<3> position;
        std::array<unsigned int, 3> node_dofs{ { none, none, none } };
        for (unsigned int d = 0; d < dim; ++d)
        {
          position[d]  = values.quadrature_point(q)[d];
          node_dofs[d] = static_cast<unsigned int>(element_dofs[on_places[q][d]]);
        }
        nodes.push_back({ position, part, at_hub });
        dofs.push_back(node_dofs);
      }
    }
    nodes_per_element = places.size();
    element_cells     = cell_corners(body.body_properties().degree, is_in_space);
    sharing.assign(nodes.size(), 0);
    for (const unsigned int node : elements)
      ++sharing[node];
    add_stress = [&body](const auto &displacement, const auto &body_elements, const auto ranks_at_work, auto &sums)
    {
      add_stresses<dim>(body.dofs(), body.cell_mapping(), body.body_properties(), displacement, body_elements, ranks_at_work,
                        sums);
    };
    n_displacements = body.n_dofs();
  }

  std::vector<Tensor<1, 3>> BodyFields::moved(const Vector<double> &displacement) const
  {
    std::vector<Tensor<1, 3>> result(nodes.size());
    for (std::size_t i = 0; i < result.size(); ++i)
      for (unsigned int d = 0; d < (is_in_space ? 3u : 2u); ++d)
        result[i][d] = displacement[dofs[i][d]];
    return result;
  }

  std::vector<NodalField> BodyFields::at(const Vector<double> &displacement) const
  {
    if (calls != nullptr)
      (*calls)(SharedTask::recover_stress);
    const auto displacements = moved(displacement);
    const auto sums          = stress_sums(displacement);
    std::vector<NodalField> result(nodes.size());
    for (std::size_t i = 0; i < result.size(); ++i)
      result[i] = { displacements[i], sums[i] / sharing[i] };
    return result;
  }

  void BodyFields::take_part() const
  {
    stress_sums(Vector<double>(n_displacements));
  }

  /// Sums the stresses of the elements that meet in a node, by the first rank's displacement, and returns them to it.
  BodyFields::StressSums BodyFields::stress_sums(Vector<double> displacement) const
  {
    MPI_Bcast(displacement.begin(), static_cast<int>(displacement.size()), MPI_DOUBLE, 0, ranks);
    StressSums result(nodes.size());
    add_stress(displacement, elements, ranks, result);
    const bool is_first   = Utilities::MPI::this_mpi_process(ranks) == 0;
    double *const numbers = &result.front().access_raw_entry(0);
    const auto n_numbers  = static_cast<int>(result.size() * StressSums::value_type::n_independent_components);
    MPI_Reduce(is_first ? MPI_IN_PLACE : numbers, numbers, n_numbers, MPI_DOUBLE, MPI_SUM, 0, ranks);
    return result;
  }
} // namespace sprag
