// SPDX-License-Identifier: GPL-3.0-only
#include "fe/body/connectors.h"

#include "base/errors.h"
#include "base/text.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace sprag
{
  using namespace dealii;

  namespace
  {
    /// Weights of displacements along the two axes, by degree of freedom.
    using Weights = std::map<unsigned int, double>;

    /// Mean displacement of a pad and its mean slope, the rate of normal displacement along the first axis.
    struct Pad
    {
      std::array<Weights, 2> mean;
      Weights slope;
      double length = 0.; ///< of what was found of it [mm]
      double height = 0.; ///< mean second coordinate [mm]
    };

    /// Part of a straight side of a cell, from one point to another along the first axis.
    template <int dim>
    struct Piece
    {
      typename DoFHandler<dim>::active_cell_iterator cell;
      Point<dim> begin;
      Point<dim> end;
    };

    template <int dim>
    std::vector<Piece<dim>> pieces_between(const DoFHandler<dim> &dof_handler, const types::boundary_id side, const double from,
                                           const double to)
    {
      std::vector<Piece<dim>> result;
      for (const auto &cell : dof_handler.active_cell_iterators())
        for (const auto &face : cell->face_iterators())
          if (face->at_boundary() && face->boundary_id() == side)
          {
            Point<dim> begin = face->vertex(0), end = face->vertex(1);
            if (begin[0] > end[0])
              std::swap(begin, end);
            const auto at = [&, whole = end - begin, origin = begin](const double xi)
            { return origin + std::clamp((xi - origin[0]) / whole[0], 0., 1.) * whole; };
            if (begin[0] < to && end[0] > from)
              result.push_back({ cell, at(from), at(to) });
          }
      return result;
    }

    /// Collects the shape functions of pieces in a pad.
    template <int dim>
    struct PadCollector
    {
      const Mapping<dim> &mapping;
      const FiniteElement<dim> &fe;
      const AffineConstraints<double> &constraints;
      const double full_length;
      const QGauss<1> rule                      = QGauss<1>(fe.degree + 1);
      std::vector<types::global_dof_index> dofs = std::vector<types::global_dof_index>(fe.n_dofs_per_cell());
      Pad pad                                   = {};

      void add(const Piece<dim> &piece)
      {
        piece.cell->get_dof_indices(dofs);
        const double length = piece.end[0] - piece.begin[0];
        for (unsigned int q = 0; q < rule.size(); ++q)
        {
          const Point<dim> point = piece.begin + rule.point(q)[0] * (piece.end - piece.begin);
          const double share     = rule.weight(q) * length / full_length;
          for_shapes(piece, point,
                     [&](const unsigned int dof, const unsigned int component, const double shape)
                     { pad.mean[component][dof] += share * shape; });
          pad.height += share * point[1];
        }
        for (const auto &[point, sign] : { std::make_pair(piece.begin, -1.), std::make_pair(piece.end, 1.) })
          for_shapes(piece, point,
                     [&, sign = sign](const unsigned int dof, const unsigned int component, const double shape)
                     {
                       if (component == 1)
                         pad.slope[dof] += sign * shape / full_length;
                     });
        pad.length += length;
      }

      template <class Use>
      void for_shapes(const Piece<dim> &piece, const Point<dim> &point, const Use &use) const
      {
        const Point<dim> unit = mapping.transform_real_to_unit_cell(piece.cell, point);
        for (unsigned int i = 0; i < dofs.size(); ++i)
          if (const auto dof = static_cast<unsigned int>(dofs[i]); !constraints.is_constrained(dof))
            use(dof, fe.system_to_component_index(i).first, fe.shape_value(i, unit));
      }
    };

    std::string name_of(const ConnectorSettings &settings)
    {
      const std::string what = settings.type == ConnectorType::sensor ? "force sensor" : "linear guide";
      return "the " + what + " at xi = " + mm(settings.middle) + ", " + mm(settings.length) + " long";
    }

    template <int dim>
    Pad pad_on(const types::boundary_id side, const std::string &side_name, const ConnectorSettings &settings,
               const Mapping<dim> &mapping, const DoFHandler<dim> &dof_handler, const AffineConstraints<double> &constraints)
    {
      const double from = settings.middle - 0.5 * settings.length;
      const double to   = settings.middle + 0.5 * settings.length;
      PadCollector<dim> collector{ mapping, dof_handler.get_fe(), constraints, settings.length };
      for (const auto &piece : pieces_between(dof_handler, side, from, to))
        collector.add(piece);
      // What a pad lacks would be missing in its mean.
      if (std::abs(collector.pad.length - settings.length) > 1e-6 * settings.length)
        throw InputError(name_of(settings) + ", does not lie wholly on the curve '" + side_name + "'");
      return std::move(collector.pad);
    }

    void add(const double factor, const Weights &weights, Weights &sum)
    {
      for (const auto &[dof, weight] : weights)
        sum[dof] += factor * weight;
    }

    Connector between(const Pad &plate, const Pad &lever, const ConnectorSettings &settings)
    {
      const unsigned int axis = settings.type == ConnectorType::sensor ? 1 : 0;
      Weights row             = plate.mean[axis];
      add(-1., lever.mean[axis], row);
      if (settings.type == ConnectorType::guide)
        add(plate.height - lever.height, lever.slope, row);
      Connector result{ settings.type, settings.stiffness, {} };
      for (const auto &[dof, weight] : row)
        if (weight != 0.)
          result.row.emplace_back(dof, weight);
      return result;
    }
  } // namespace

  template <int dim>
  std::vector<Connector> find_connectors(const Mapping<dim> &mapping, const DoFHandler<dim> &dof_handler,
                                         const AffineConstraints<double> &constraints,
                                         const std::vector<ConnectorSettings> &settings)
  {
    std::vector<Connector> result;
    for (const auto &connector : settings)
    {
      const auto pad = [&](const types::boundary_id side, const std::string &name)
      { return pad_on(side, name, connector, mapping, dof_handler, constraints); };
      result.push_back(
          between(pad(boundary_id::sensor_plate, "sensor plate"), pad(boundary_id::sensor_lever, "sensor lever"), connector));
    }
    return result;
  }

  template std::vector<Connector> find_connectors(const Mapping<2> &, const DoFHandler<2> &, const AffineConstraints<double> &,
                                                  const std::vector<ConnectorSettings> &);
} // namespace sprag
