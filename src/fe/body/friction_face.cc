#include "fe/body/friction_face.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_values.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace sprag
{
  using namespace dealii;

  namespace
  {
    /// Two Gauss points in each part integrate a uniform pressure against quadratic shape functions exactly.
    unsigned int number_of_parts(const double length, const double spacing)
    {
      return static_cast<unsigned int>(std::clamp(std::ceil(length / (2. * spacing)), 4., 24.));
    }

    /// Collects the faces of cells one by one.
    template <int dim>
    struct Collector
    {
      const Mapping<dim> &mapping;
      const FiniteElement<dim> &fe;
      const AffineConstraints<double> &constraints;
      const BodyProperties &properties;

      struct OfCell
      {
        std::vector<FacePoint<dim>> points;
        FaceEdge<dim> edge;
        double length;
      };
      std::vector<OfCell> cells                                 = {};
      std::map<unsigned int, FEFaceValues<dim>> values_by_parts = {};
      std::map<unsigned int, unsigned int> index_by_dof         = {};
      FrictionFace<dim> result                                  = {};

      void add(const typename DoFHandler<dim>::active_cell_iterator &cell, const unsigned int f)
      {
        const double length  = cell->face(f)->diameter();
        result.depth         = std::max(result.depth, cell->measure() / cell->face(f)->measure());
        result.young_modulus = std::max(result.young_modulus, properties.constants.at(cell->material_id()).young_modulus);

        auto &values = values_for(number_of_parts(length, properties.point_spacing));
        values.reinit(cell, f);
        std::vector<FacePoint<dim>> points;
        for (const unsigned int q : values.quadrature_point_indices())
          points.push_back({ values.quadrature_point(q), properties.width_of(cell->material_id()) * values.JxW(q), {} });
        FaceEdge<dim> edge;
        add_nodes(cell, f, values, points, edge);
        const auto is_before = [](const auto &a, const auto &b) { return a.position[0] < b.position[0]; };
        std::sort(points.begin(), points.end(), is_before);
        std::sort(edge.nodes.begin(), edge.nodes.end(), is_before);
        cells.push_back({ std::move(points), std::move(edge), length });
      }

      FrictionFace<dim> face()
      {
        std::sort(cells.begin(), cells.end(),
                  [](const auto &a, const auto &b) { return a.points.front().position[0] < b.points.front().position[0]; });
        for (const auto &[points, edge, length] : cells)
        {
          const auto begin = static_cast<unsigned int>(result.points.size());
          result.points.insert(result.points.end(), points.begin(), points.end());
          result.patches.push_back({ begin, static_cast<unsigned int>(result.points.size()), length });
          result.edges.push_back(edge);
        }
        return result;
      }

      FEFaceValues<dim> &values_for(const unsigned int parts)
      {
        const UpdateFlags flags = update_values | update_JxW_values | update_quadrature_points;
        return values_by_parts.try_emplace(parts, mapping, fe, QIterated<dim - 1>(QGauss<1>(2), parts), flags).first->second;
      }

      void add_nodes(const typename DoFHandler<dim>::active_cell_iterator &cell, const unsigned int f,
                     const FEFaceValues<dim> &values, std::vector<FacePoint<dim>> &points, FaceEdge<dim> &edge)
      {
        std::vector<types::global_dof_index> indices(fe.n_dofs_per_cell());
        cell->get_dof_indices(indices);
        for (unsigned int i = 0; i < fe.n_dofs_per_face(); i += dim)
        {
          const unsigned int in_cell = fe.face_to_cell_index(i, f);
          std::array<unsigned int, dim> dofs;
          for (unsigned int d = 0; d < dim; ++d)
            dofs[d] = indices[fe.face_to_cell_index(i + d, f)];
          const auto position = mapping.transform_unit_to_real_cell(cell, fe.get_unit_support_points()[in_cell]);
          edge.nodes.push_back({ position, FaceEdge<dim>::held });
          if (constraints.is_constrained(dofs[0]))
            continue;
          const auto node = index_by_dof.try_emplace(dofs[0], static_cast<unsigned int>(result.nodes.size()));
          if (node.second)
            result.nodes.push_back({ position, dofs });
          edge.nodes.back().index = node.first->second;
          for (const unsigned int q : values.quadrature_point_indices())
            points[q].nodes.emplace_back(node.first->second, values.shape_value(in_cell, q));
        }
      }
    };
  } // namespace

  template <int dim>
  FrictionFace<dim> find_friction_face(const Mapping<dim> &mapping, const DoFHandler<dim> &dof_handler,
                                       const AffineConstraints<double> &constraints, const BodyProperties &properties,
                                       const types::boundary_id boundary)
  {
    Collector<dim> collector{ mapping, dof_handler.get_fe(), constraints, properties };
    for (const auto &cell : dof_handler.active_cell_iterators())
      for (const unsigned int f : cell->face_indices())
        if (cell->face(f)->at_boundary() && cell->face(f)->boundary_id() == boundary)
          collector.add(cell, f);
    return collector.face();
  }

  template FrictionFace<2> find_friction_face(const Mapping<2> &, const DoFHandler<2> &, const AffineConstraints<double> &,
                                              const BodyProperties &, types::boundary_id);
} // namespace sprag
