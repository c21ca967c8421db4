// SPDX-License-Identifier: GPL-3.0-only
#include "fe/solid/bond_loads.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_values.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

namespace sprag
{
  using namespace dealii;

  namespace
  {
    /// Hats over some places, of which the first and the last go on as they are beyond them.
    struct Hats
    {
      std::vector<double> places; ///< increasing

      unsigned int number() const
      {
        return static_cast<unsigned int>(places.size());
      }

      double operator()(const unsigned int hat, const double place) const
      {
        if (place < places[hat])
          return hat == 0 ? 1. : std::max(0., (place - places[hat - 1]) / (places[hat] - places[hat - 1]));
        if (place > places[hat])
          return hat + 1 == number() ? 1. : std::max(0., (places[hat + 1] - place) / (places[hat + 1] - places[hat]));
        return 1.;
      }
    };

    /// Places between cells of the face along an axis, at least a spacing apart: with fewer hats than cells no two loads are
    /// the same.
    Hats hats_between_cells(const FrictionFace<3> &face, const unsigned int axis, const double begin, const double end,
                            const double spacing)
    {
      std::set<long> sides; // in nanometres
      for (const auto &edge : face.edges)
      {
        const auto is_before = [axis](const auto &a, const auto &b) { return a.position[axis] < b.position[axis]; };
        const auto both      = std::minmax_element(edge.nodes.begin(), edge.nodes.end(), is_before);
        sides.insert({ std::lround(1e6 * both.first->position[axis]), std::lround(1e6 * both.second->position[axis]) });
      }
      Hats result;
      double last = begin;
      for (const long side : sides)
        if (const double place = 1e-6 * static_cast<double>(side); place >= begin && place <= end)
        {
          if (result.places.empty() || place >= result.places.back() + 0.999 * spacing)
            result.places.push_back(place);
          last = place;
        }
      if (result.places.empty())
        result.places.push_back(0.5 * (begin + end));
      else if (result.places.size() > 1)
        result.places.back() = last;
      return result;
    }

    bool is_bond(const SolidBody &body, const DoFHandler<3>::active_cell_iterator &cell, const unsigned int f)
    {
      return body.is_skin(cell) && !cell->at_boundary(f) && !body.is_skin(cell->neighbor(f));
    }
  } // namespace

  SparseColumns bond_loads(const SolidBody &body, const BondGrid &grid)
  {
    constexpr double whole = std::numeric_limits<double>::max();
    const auto along       = hats_between_cells(body.friction_face(), 0, grid.begin, grid.end, grid.spacing_xi);
    const auto across      = hats_between_cells(body.friction_face(), 2, -whole, whole, grid.spacing_zeta);

    const auto &fe = body.dofs().get_fe();
    FEFaceValues<3> values(body.cell_mapping(), fe, QGauss<2>(fe.degree + 1),
                           update_values | update_quadrature_points | update_JxW_values);
    std::vector<std::map<unsigned int, double>> columns(3 * along.number() * across.number());
    std::vector<types::global_dof_index> indices(fe.n_dofs_per_cell());
    for (const auto &cell : body.dofs().active_cell_iterators())
      for (const unsigned int f : cell->face_indices())
        if (is_bond(body, cell, f))
        {
          values.reinit(cell, f);
          cell->get_dof_indices(indices);
          for (const unsigned int q : values.quadrature_point_indices())
          {
            const auto &place = values.quadrature_point(q);
            for (unsigned int i = 0; i < along.number(); ++i)
              for (unsigned int k = 0; k < across.number(); ++k)
                if (const double hat = along(i, place[0]) * across(k, place[2]); hat > 0.)
                  for (unsigned int a = 0; a < fe.n_dofs_per_face(); ++a)
                  {
                    const unsigned int in_cell   = fe.face_to_cell_index(a, f);
                    const unsigned int direction = fe.system_to_component_index(in_cell).first;
                    if (!body.is_held(indices[in_cell]))
                      columns[3 * (i * across.number() + k) + direction][indices[in_cell]] +=
                          values.JxW(q) * hat * values.shape_value(in_cell, q);
                  }
          }
        }
    SparseColumns result;
    for (const auto &column : columns)
      if (!column.empty())
      {
        for (const auto &[dof, force] : column)
          result.add(dof, force);
        result.end_column();
      }
    return result;
  }
} // namespace sprag
