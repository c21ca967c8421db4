// SPDX-License-Identifier: GPL-3.0-only
#include "fe/body/connectors.h"

#include "base/errors.h"
#include "base/text.h"
#include "fe/body/elastic_body.h"
#include "fe/body/end_face.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_values.h>

#include <algorithm>
#include <cmath>

namespace sprag
{
  using namespace dealii;

  template <int dim>
  double PadRange<dim>::measure() const
  {
    double result = 1.;
    for (unsigned int i = 0; i < dim - 1; ++i)
      result *= std::max(0., end[i] - begin[i]);
    return result;
  }

  template <int dim>
  PadRange<dim> PadRange<dim>::within(const PadRange &other) const
  {
    PadRange result = *this;
    for (unsigned int i = 0; i < dim - 1; ++i)
    {
      result.begin[i] = std::max(begin[i], other.begin[i]);
      result.end[i]   = std::min(end[i], other.end[i]);
    }
    return result;
  }

  namespace
  {
    // Coordinate 2 i is xi or zeta.

    template <int dim, class Face>
    PadRange<dim> face_outline(const Face &face)
    {
      const auto [lower, upper] = face->bounding_box().get_boundary_points();
      PadRange<dim> result;
      for (unsigned int i = 0; i < dim - 1; ++i)
      {
        result.begin[i] = lower[2 * i];
        result.end[i]   = upper[2 * i];
      }
      return result;
    }

    template <class Face>
    bool is_rectangle(const Face &face)
    {
      const double area = face_outline<3>(face).measure();
      const auto a = face->vertex(1) - face->vertex(0), b = face->vertex(2) - face->vertex(0),
                 c         = face->vertex(3) - face->vertex(0);
      const double doubled = std::abs(c[0] * (a[2] - b[2]) - c[2] * (a[0] - b[0])); // of its area as seen along eta
      return std::abs(0.5 * doubled - area) < 1e-6 * area;
    }

    /// The place on a straight or rectangular face at a share of a piece of its outline.
    template <int dim, class Face>
    Point<dim> place_on(const Face &face, const PadRange<dim> &outline, const PadRange<dim> &piece, const Point<dim - 1> &share)
    {
      Point<dim> result;
      std::array<double, dim - 1> at_face;
      for (unsigned int i = 0; i < dim - 1; ++i)
      {
        result[2 * i] = piece.begin[i] + share[i] * (piece.end[i] - piece.begin[i]);
        at_face[i]    = (result[2 * i] - outline.begin[i]) / (outline.end[i] - outline.begin[i]);
      }
      for (const unsigned int v : face->vertex_indices())
      {
        double vertex_weight = 1.;
        for (unsigned int i = 0; i < dim - 1; ++i)
          vertex_weight *= face->vertex(v)[2 * i] > 0.5 * (outline.begin[i] + outline.end[i]) ? at_face[i] : 1. - at_face[i];
        result[1] += vertex_weight * face->vertex(v)[1];
      }
      return result;
    }

    std::string to_text(const PadRange<2> &pad)
    {
      return "xi = " + mm(0.5 * (pad.begin[0] + pad.end[0])) + ", " + mm(pad.end[0] - pad.begin[0]) + " long,";
    }

    std::string to_text(const PadRange<3> &pad)
    {
      return "xi = " + rounded_text(pad.begin[0]) + " to " + mm(pad.end[0]) + " and zeta = " + rounded_text(pad.begin[1]) +
             " to " + mm(pad.end[1]);
    }

    DofWeights difference(const DofWeights &plate_weights, const DofWeights &lever_weights)
    {
      DofWeights result = plate_weights;
      for (const auto &[dof, weight] : lever_weights)
        result[dof] -= weight;
      return result;
    }
  } // namespace

  /// Collects the shape functions of the pieces of a side within a range.
  template <int dim>
  struct FacingPads<dim>::Collector
  {
    const ElasticBody<dim> &body;
    const PadRange<dim> range;
    Pad pad = {};

    void add(const typename DoFHandler<dim>::active_cell_iterator &cell, const unsigned int f)
    {
      const auto outline = face_outline<dim>(cell->face(f));
      const auto piece   = outline.within(range);
      if (piece.measure() <= 1e-9 * outline.measure())
        return;
      const auto &fe = body.dofs().get_fe();
      const QGauss<dim - 1> rule(fe.degree + 1);
      std::vector<Point<dim>> places, in_cell;
      for (const auto &point : rule.get_points())
      {
        places.push_back(place_on<dim>(cell->face(f), outline, piece, point));
        in_cell.push_back(body.cell_mapping().transform_real_to_unit_cell(cell, places.back()));
      }
      FEValues<dim> values(body.cell_mapping(), fe, Quadrature<dim>(in_cell), update_values | update_gradients);
      values.reinit(cell);
      const auto dofs = cell_dofs(cell);
      for (unsigned int q = 0; q < rule.size(); ++q)
      {
        const double share = rule.weight(q) * piece.measure() / range.measure();
        pad.measure += rule.weight(q) * piece.measure();
        pad.height += share * places[q][1];
        for (unsigned int i = 0; i < dofs.size(); ++i)
          if (const auto dof = static_cast<unsigned int>(dofs[i]); !body.held().is_constrained(dof))
            add(dof, fe.system_to_component_index(i).first, values.shape_value(i, q), values.shape_grad(i, q), share, places[q]);
      }
    }

    void add(const unsigned int dof, const unsigned int component, const double shape, const Tensor<1, dim> &gradient,
             const double share, const Point<dim> &place)
    {
      pad.mean[component][dof] += share * shape;
      if (component == 1)
        for (unsigned int i = 0; i < dim - 1; ++i)
          pad.slope[i][dof] += share * gradient[2 * i];
      if constexpr (dim == 3)
        if (component == 0)
        {
          const double mean_square =
              (std::pow(range.end[1], 3) - std::pow(range.begin[1], 3)) / 3. / (range.end[1] - range.begin[1]); // of zeta
          pad.turn[dof] += share * place[2] * shape / mean_square;
        }
    }
  };

  template <int dim>
  FacingPads<dim>::FacingPads(const ConnectorType type, const PadRange<dim> &range, const ElasticBody<dim> &body)
      : plate(pad_on(boundary_id::sensor_plate, "sensor plate", type, range, body))
      , lever(pad_on(boundary_id::sensor_lever, "sensor lever", type, range, body))
  {
  }

  template <int dim>
  typename FacingPads<dim>::Pad FacingPads<dim>::pad_on(const types::boundary_id side, const std::string &name,
                                                        const ConnectorType type, const PadRange<dim> &range,
                                                        const ElasticBody<dim> &body)
  {
    Collector collector{ body, range };
    for (const auto &[cell, f] : boundary_faces(body.dofs(), side))
    {
      if constexpr (dim == 3)
        if (!is_rectangle(cell->face(f)))
          throw InputError("the surface '" + name + "', which sensors press on, must be made of rectangles along xi and zeta");
      collector.add(cell, f);
    }
    // A pad that lacks a part would have a wrong mean.
    if (std::abs(collector.pad.measure - range.measure()) > 1e-6 * range.measure())
      throw InputError((type == ConnectorType::sensor ? "the force sensor at " : "the linear guide at ") + to_text(range) +
                       " does not lie wholly on the " + (dim == 2 ? "curve '" : "surface '") + name + "'");
    return std::move(collector.pad);
  }

  template <int dim>
  DofWeights FacingPads<dim>::approach() const
  {
    return difference(plate.mean[1], lever.mean[1]);
  }

  template <int dim>
  DofWeights FacingPads<dim>::shift(const unsigned int direction) const
  {
    auto result = difference(plate.mean[2 * direction], lever.mean[2 * direction]);
    for (const auto &[dof, weight] : lever.slope[direction])
      result[dof] += (plate.height - lever.height) * weight;
    return result;
  }

  template <int dim>
  DofWeights FacingPads<dim>::turn() const
  {
    return difference(plate.turn, lever.turn);
  }

  Connector connector(const ConnectorType type, const double stiffness, const DofWeights &row)
  {
    Connector result{ type, stiffness, {} };
    for (const auto &[dof, weight] : row)
      if (weight != 0.)
        result.row.emplace_back(dof, weight);
    return result;
  }

  std::vector<Connector> find_connectors(const ElasticBody<2> &body, const std::vector<ConnectorSettings> &settings)
  {
    std::vector<Connector> result;
    for (const auto &[type, middle, length, stiffness] : settings)
    {
      const FacingPads<2> pads(type, { { { middle - 0.5 * length } }, { { middle + 0.5 * length } } }, body);
      result.push_back(connector(type, stiffness, type == ConnectorType::sensor ? pads.approach() : pads.shift(0)));
    }
    return result;
  }

  template class FacingPads<2>;
  template class FacingPads<3>;
} // namespace sprag
