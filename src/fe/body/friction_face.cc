// SPDX-License-Identifier: GPL-3.0-only
#include "fe/body/friction_face.h"

#include "base/errors.h"
#include "base/ranges.h"
#include "fe/body/end_face.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_values.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

namespace sprag
{
  using namespace dealii;

  namespace
  {
    /// Two Gauss points in each part integrate a uniform pressure against quadratic shape functions exactly.
    unsigned int count_parts(const double length, const double spacing)
    {
      return static_cast<unsigned int>(std::clamp(std::ceil(length / (2. * spacing)), 4., 24.));
    }

    /// Integrates the pressure under a tilted cylinder, quadratic across the width, exactly.
    constexpr unsigned int points_across = 3;

    /// Along the first axis.
    template <int dim, class Face>
    double face_length(const Face &face)
    {
      if constexpr (dim == 2)
        return face->diameter();
      const auto [lower, upper] = face->bounding_box().get_boundary_points();
      return upper[0] - lower[0];
    }

    /// Returns true if the first direction of the face's own coordinates goes along the first axis.
    template <int dim, class Face>
    bool goes_along(const Face &face)
    {
      if constexpr (dim == 2)
        return true;
      else
        return std::abs(face->vertex(1)[0] - face->vertex(0)[0]) > std::abs(face->vertex(2)[0] - face->vertex(0)[0]);
    }

    template <int dim>
    Quadrature<dim - 1> make_quadrature(const unsigned int parts, const bool along)
    {
      const QIterated<1> dense(QGauss<1>(2), parts);
      if constexpr (dim == 2)
        return dense;
      else
      {
        const QGauss<1> across(points_across);
        return along ? QAnisotropic<2>(dense, across) : QAnisotropic<2>(across, dense);
      }
    }

    /// Orders places along the first axis, those with the same coordinate up to round-off along the last.
    template <int dim>
    bool is_before(const Point<dim> &a, const Point<dim> &b)
    {
      const double same = 1e-9 * (1. + std::abs(a[0]));
      if (dim == 2 || std::abs(a[0] - b[0]) > same)
        return a[0] < b[0];
      return a[dim - 1] < b[dim - 1];
    }

    /// Collects the faces of cells one by one.
    template <int dim>
    struct Collector
    {
      const Mapping<dim> &mapping;
      const FiniteElement<dim> &fe;
      const AffineConstraints<double> &constraints;
      const BodyProperties &properties;

      struct CellPart
      {
        std::vector<FacePoint<dim>> points;
        FaceElement<dim> element;
        FaceEdge<dim> edge;
      };
      std::vector<CellPart> cells                                                = {};
      std::map<std::pair<unsigned int, bool>, FEFaceValues<dim>> values_by_parts = {};
      std::map<unsigned int, unsigned int> index_by_dof                          = {};
      FrictionFace<dim> result                                                   = {};

      void add(const typename DoFHandler<dim>::active_cell_iterator &cell, const unsigned int f)
      {
        const double length  = face_length<dim>(cell->face(f));
        result.depth         = std::max(result.depth, cell->measure() / cell->face(f)->measure());
        result.young_modulus = std::max(result.young_modulus, properties.constants.at(cell->material_id()).young_modulus);

        auto &values = values_for(count_parts(length, properties.point_spacing), goes_along<dim>(cell->face(f)));
        values.reinit(cell, f);
        CellPart part{ {}, { 0, 0, length }, {} };
        for (const unsigned int q : values.quadrature_point_indices())
          part.points.push_back({ values.quadrature_point(q), properties.material_width(cell->material_id()) * values.JxW(q) });
        add_nodes(cell, f, values, part);
        const auto by_place = [](const auto &a, const auto &b) { return is_before(a.position, b.position); };
        std::sort(part.points.begin(), part.points.end(), by_place);
        std::sort(part.edge.nodes.begin(), part.edge.nodes.end(), by_place);
        cells.push_back(std::move(part));
      }

      FrictionFace<dim> face()
      {
        std::sort(cells.begin(), cells.end(),
                  [](const auto &a, const auto &b) { return is_before(a.points.front().position, b.points.front().position); });
        for (const auto &[points, element, edge] : cells)
        {
          auto &added = result.elements.emplace_back(element);
          added.begin = static_cast<unsigned int>(result.points.size());
          append(result.points, points);
          added.end = static_cast<unsigned int>(result.points.size());
          result.edges.push_back(edge);
        }
        return result;
      }

      FEFaceValues<dim> &values_for(const unsigned int parts, const bool along)
      {
        const UpdateFlags flags = update_values | update_JxW_values | update_quadrature_points | update_gradients;
        const auto quadrature   = make_quadrature<dim>(parts, along);
        return values_by_parts.try_emplace({ parts, along }, mapping, fe, quadrature, flags).first->second;
      }

      void add_nodes(const typename DoFHandler<dim>::active_cell_iterator &cell, const unsigned int f,
                     const FEFaceValues<dim> &values, CellPart &part)
      {
        const auto indices = cell_dofs(cell);
        for (unsigned int i = 0; i < fe.n_dofs_per_face(); i += dim)
        {
          const unsigned int in_cell = fe.face_to_cell_index(i, f);
          std::array<unsigned int, dim> dofs;
          for (unsigned int d = 0; d < dim; ++d)
            dofs[d] = indices[fe.face_to_cell_index(i + d, f)];
          const auto position = mapping.transform_unit_to_real_cell(cell, fe.get_unit_support_points()[in_cell]);
          part.edge.nodes.push_back({ position, FaceEdge<dim>::held });
          if (constraints.is_constrained(dofs[0]))
            continue;
          const auto node = index_by_dof.try_emplace(dofs[0], static_cast<unsigned int>(result.nodes.size()));
          if (node.second)
            result.nodes.push_back({ position, dofs });
          part.edge.nodes.back().index               = node.first->second;
          auto &[begin, end, length, n_nodes, nodes] = part.element;
          if (n_nodes == nodes.size())
            throw AnalysisError("contact is limited to elements of degree 2");
          for (const unsigned int q : values.quadrature_point_indices())
          {
            part.points[q].shapes[n_nodes] = values.shape_value(in_cell, q);
            part.points[q].slopes[n_nodes] = values.shape_grad(in_cell, q)[0];
          }
          nodes[n_nodes++] = node.first->second;
        }
      }
    };

    /// Orders the nodes along the first axis, those with the same coordinate along the last.
    template <int dim>
    void order_nodes(FrictionFace<dim> &face)
    {
      std::vector<unsigned int> order(face.nodes.size()), place(face.nodes.size());
      std::iota(order.begin(), order.end(), 0u);
      const auto rounded = [&](const unsigned int node, const unsigned int d)
      { return std::lround(1e6 * face.nodes[node].position[d]); };
      std::sort(order.begin(), order.end(),
                [&](const unsigned int a, const unsigned int b)
                { return std::pair(rounded(a, 0), rounded(a, dim - 1)) < std::pair(rounded(b, 0), rounded(b, dim - 1)); });
      std::vector<FaceNode<dim>> ordered;
      for (unsigned int i = 0; i < order.size(); ++i)
      {
        place[order[i]] = i;
        ordered.push_back(face.nodes[order[i]]);
      }
      face.nodes = std::move(ordered);
      for (auto &element : face.elements)
        for (unsigned int a = 0; a < element.n_nodes; ++a)
          element.nodes[a] = place[element.nodes[a]];
      for (auto &edge : face.edges)
        for (auto &node : edge.nodes)
          if (node.index != FaceEdge<dim>::held)
            node.index = place[node.index];
    }
  } // namespace

  template <int dim>
  FrictionFace<dim> find_friction_face(const Mapping<dim> &mapping, const DoFHandler<dim> &dof_handler,
                                       const AffineConstraints<double> &constraints, const BodyProperties &properties,
                                       const types::boundary_id boundary)
  {
    Collector<dim> collector{ mapping, dof_handler.get_fe(), constraints, properties };
    for (const auto &[cell, f] : boundary_faces(dof_handler, boundary))
      collector.add(cell, f);
    auto face = collector.face();
    if (dim == 3)
      order_nodes(face);
    return face;
  }

  template <int dim>
  std::vector<std::vector<unsigned int>> lines_along(const std::vector<Point<dim>> &places)
  {
    std::map<long, std::vector<unsigned int>> by_zeta;
    for (unsigned int i = 0; i < places.size(); ++i)
      by_zeta[dim == 3 ? std::lround(1e6 * places[i][dim - 1]) : 0].push_back(i);
    std::vector<std::vector<unsigned int>> result;
    for (auto &[zeta, line] : by_zeta)
    {
      std::sort(line.begin(), line.end(),
                [&](const unsigned int a, const unsigned int b) { return places[a][0] < places[b][0]; });
      result.push_back(std::move(line));
    }
    return result;
  }

  template <int dim>
  std::vector<std::vector<unsigned int>> lines_along(const FrictionFace<dim> &face)
  {
    return filtered(lines_along(mapped(face.nodes, &FaceNode<dim>::position)), [](const auto &line) { return line.size() >= 3; });
  }

  template std::vector<std::vector<unsigned int>> lines_along(const std::vector<Point<2>> &);
  template std::vector<std::vector<unsigned int>> lines_along(const std::vector<Point<3>> &);
  template std::vector<std::vector<unsigned int>> lines_along(const FrictionFace<2> &);
  template std::vector<std::vector<unsigned int>> lines_along(const FrictionFace<3> &);
  template FrictionFace<2> find_friction_face(const Mapping<2> &, const DoFHandler<2> &, const AffineConstraints<double> &,
                                              const BodyProperties &, types::boundary_id);
  template FrictionFace<3> find_friction_face(const Mapping<3> &, const DoFHandler<3> &, const AffineConstraints<double> &,
                                              const BodyProperties &, types::boundary_id);
} // namespace sprag
