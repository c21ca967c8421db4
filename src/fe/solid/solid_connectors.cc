// SPDX-License-Identifier: GPL-3.0-only
#include "fe/solid/solid_connectors.h"

#include "base/errors.h"
#include "base/text.h"
#include "scene/across.h"
#include "scene/scene.h"

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
    /// Weights of displacements, by degree of freedom.
    using Weights = std::map<unsigned int, double>;

    /// A rectangle of xi and zeta.
    struct Rectangle
    {
      std::array<double, 2> begin, end;

      double area() const
      {
        return std::max(0., end[0] - begin[0]) * std::max(0., end[1] - begin[1]);
      }

      /// Integral of zeta^2.
      double second_moment() const
      {
        return (end[0] - begin[0]) * (std::pow(end[1], 3) - std::pow(begin[1], 3)) / 3.;
      }

      Rectangle within(const Rectangle &other) const
      {
        Rectangle result = *this;
        for (unsigned int i = 0; i < 2; ++i)
        {
          result.begin[i] = std::max(begin[i], other.begin[i]);
          result.end[i]   = std::min(end[i], other.end[i]);
        }
        return result;
      }
    };

    /// Mean displacement of a pad, mean slopes of that along eta towards xi and zeta, and its turn about eta.
    struct Pad
    {
      std::array<Weights, 3> mean;
      std::array<Weights, 2> slope;
      Weights turn;
      double area   = 0.; ///< of what was found of it [mm^2]
      double height = 0.; ///< mean eta [mm]
    };

    template <class Face>
    Rectangle outline_of(const Face &face)
    {
      Rectangle result{ { { face->vertex(0)[0], face->vertex(0)[2] } }, { { face->vertex(0)[0], face->vertex(0)[2] } } };
      for (const unsigned int v : face->vertex_indices())
        for (unsigned int i = 0; i < 2; ++i)
        {
          result.begin[i] = std::min(result.begin[i], face->vertex(v)[2 * i]);
          result.end[i]   = std::max(result.end[i], face->vertex(v)[2 * i]);
        }
      return result;
    }

    template <class Face>
    bool is_rectangle(const Face &face)
    {
      const auto outline = outline_of(face);
      const auto a = face->vertex(1) - face->vertex(0), b = face->vertex(2) - face->vertex(0),
                 c           = face->vertex(3) - face->vertex(0);
      const double round_off = 1e-6 * outline.area();
      const double doubled   = std::abs(c[0] * (a[2] - b[2]) - c[2] * (a[0] - b[0])); // of its area as seen along eta
      return std::abs(0.5 * doubled - outline.area()) < round_off;
    }

    /// Collects the shape functions of the pieces of a side within a rectangle.
    struct PadCollector
    {
      const PlateAndLever &body;
      const Rectangle rectangle;
      Pad pad = {};

      void add(const DoFHandler<3>::active_cell_iterator &cell, const unsigned int f)
      {
        const auto outline = outline_of(cell->face(f));
        const auto piece   = outline.within(rectangle);
        if (piece.area() <= 1e-9 * outline.area())
          return;
        const auto &fe = body.dof_handler.get_fe();
        const QGauss<2> rule(fe.degree + 1);
        std::vector<Point<3>> places, in_cell;
        for (const auto &point : rule.get_points())
        {
          places.push_back(place_on(*cell->face(f), outline, piece, point));
          in_cell.push_back(body.mapping.transform_real_to_unit_cell(cell, places.back()));
        }
        FEValues<3> values(body.mapping, fe, Quadrature<3>(in_cell), update_values | update_gradients);
        values.reinit(cell);
        std::vector<types::global_dof_index> dofs(fe.n_dofs_per_cell());
        cell->get_dof_indices(dofs);
        for (unsigned int q = 0; q < rule.size(); ++q)
        {
          const double area = rule.weight(q) * piece.area();
          pad.area += area;
          pad.height += area / rectangle.area() * places[q][1];
          for (unsigned int i = 0; i < dofs.size(); ++i)
            if (const auto dof = static_cast<unsigned int>(dofs[i]); !body.constraints.is_constrained(dof))
              add(dof, fe.system_to_component_index(i).first, values.shape_value(i, q), values.shape_grad(i, q), area, places[q]);
        }
      }

      void add(const unsigned int dof, const unsigned int component, const double shape, const Tensor<1, 3> &gradient,
               const double area, const Point<3> &place)
      {
        const double share = area / rectangle.area();
        pad.mean[component][dof] += share * shape;
        if (component == 0)
          pad.turn[dof] += area * place[2] * shape / rectangle.second_moment();
        if (component == 1)
          for (unsigned int i = 0; i < 2; ++i)
            pad.slope[i][dof] += share * gradient[2 * i];
      }

      /// The place on a rectangular face at a share of a piece of its outline.
      template <class Face>
      static Point<3> place_on(const Face &face, const Rectangle &outline, const Rectangle &piece, const Point<2> &share)
      {
        Point<3> result;
        std::array<double, 2> of_face;
        for (unsigned int i = 0; i < 2; ++i)
        {
          result[2 * i] = piece.begin[i] + share[i] * (piece.end[i] - piece.begin[i]);
          of_face[i]    = (result[2 * i] - outline.begin[i]) / (outline.end[i] - outline.begin[i]);
        }
        for (const unsigned int v : face.vertex_indices())
        {
          double of_vertex = 1.;
          for (unsigned int i = 0; i < 2; ++i)
            of_vertex *= face.vertex(v)[2 * i] > 0.5 * (outline.begin[i] + outline.end[i]) ? of_face[i] : 1. - of_face[i];
          result[1] += of_vertex * face.vertex(v)[1];
        }
        return result;
      }
    };

    std::string text_of(const Rectangle &pad)
    {
      return "xi = " + rounded_text(pad.begin[0]) + " to " + mm(pad.end[0]) + " and zeta = " + rounded_text(pad.begin[1]) +
             " to " + mm(pad.end[1]);
    }

    Pad pad_on(const types::boundary_id side, const std::string &name, const Rectangle &rectangle, const PlateAndLever &body)
    {
      PadCollector collector{ body, rectangle };
      for (const auto &cell : body.dof_handler.active_cell_iterators())
        for (const unsigned int f : cell->face_indices())
          if (cell->face(f)->at_boundary() && cell->face(f)->boundary_id() == side)
          {
            if (!is_rectangle(cell->face(f)))
              throw InputError("the surface '" + name +
                               "', which sensors press on, must be made of rectangles along xi and zeta");
            collector.add(cell, f);
          }
      if (std::abs(collector.pad.area - rectangle.area()) > 1e-6 * rectangle.area())
        throw InputError("a force sensor or the linear guide at " + text_of(rectangle) + " does not lie wholly on the surface '" +
                         name + "'");
      return std::move(collector.pad);
    }

    void add(const double factor, const Weights &weights, Weights &sum)
    {
      for (const auto &[dof, weight] : weights)
        sum[dof] += factor * weight;
    }

    Connector connector(const ConnectorType type, const double stiffness, const Weights &row)
    {
      Connector result{ type, stiffness, {} };
      for (const auto &[dof, weight] : row)
        if (weight != 0.)
          result.row.emplace_back(dof, weight);
      return result;
    }

    /// Pads of plate and lever that face each other.
    struct Pads
    {
      Pad plate, lever;

      Pads(const Rectangle &rectangle, const PlateAndLever &body)
          : plate(pad_on(boundary_id::sensor_plate, "sensor plate", rectangle, body))
          , lever(pad_on(boundary_id::sensor_lever, "sensor lever", rectangle, body))
      {
      }

      static Weights difference(const Weights &of_plate, const Weights &of_lever)
      {
        Weights result = of_plate;
        add(-1., of_lever, result);
        return result;
      }

      Weights approach() const
      {
        return difference(plate.mean[1], lever.mean[1]);
      }

      /// Of the plate against a rigid block on the lever's pad, along xi (0) or zeta (1).
      Weights shift(const unsigned int direction) const
      {
        Weights result = difference(plate.mean[2 * direction], lever.mean[2 * direction]);
        add(plate.height - lever.height, lever.slope[direction], result);
        return result;
      }

      Weights turn() const
      {
        return difference(plate.turn, lever.turn);
      }
    };

    void add_guide(const PlateAndLever &body, const Scene &scene, std::vector<Connector> &result)
    {
      const auto &plate      = scene.plate;
      const double half      = 0.5 * scene.lever.width;
      const double xi        = 0.5 * plate.sensor_length;
      const double stiffness = plate.guide_stiffness;
      const Pads pads({ { { plate.guide - xi, body.is_half ? 0. : -half } }, { { plate.guide + xi, half } } }, body);
      result.push_back(connector(ConnectorType::guide, stiffness, pads.shift(0)));
      if (body.is_half)
        return;
      result.push_back(connector(ConnectorType::guide, stiffness, pads.shift(1)));
      result.push_back(connector(ConnectorType::guide, stiffness * half * half / 3., pads.turn()));
    }
  } // namespace

  std::vector<Connector> find_connectors(const PlateAndLever &body, const Scene &scene)
  {
    const auto &plate = scene.plate;
    std::vector<Connector> result;
    if (plate.type == PlateType::none)
      return result;
    const double middle = sensors_across(scene), xi = 0.5 * plate.sensor_length, zeta = 0.5 * plate.sensor_width;
    for (const double place : plate.sensors)
      for (const double side : { -1., 1. })
      {
        if (body.is_half && side < 0.)
          continue;
        const Pads pads({ { { place - xi, side * middle - zeta } }, { { place + xi, side * middle + zeta } } }, body);
        const double share = body.is_half ? 1. : 0.5;
        result.push_back(connector(ConnectorType::sensor, share * plate.sensor_stiffness, pads.approach()));
      }
    add_guide(body, scene, result);
    return result;
  }

  void add(const Connector &connector, SymmetricEntries &stiffness)
  {
    for (const auto &[row, of_row] : connector.row)
      for (const auto &[column, of_column] : connector.row)
        if (row <= column)
        {
          stiffness.row.push_back(static_cast<int>(row) + 1);
          stiffness.column.push_back(static_cast<int>(column) + 1);
          stiffness.value.push_back(connector.stiffness * of_row * of_column);
        }
  }
} // namespace sprag
