// SPDX-License-Identifier: GPL-3.0-only
#include "fe/mesh/mesh_checks.h"

#include "base/text.h"
#include "fe/body/body_properties.h"

#include <deal.II/base/bounding_box.h>
#include <deal.II/grid/grid_tools.h>

#include <boost/algorithm/string/join.hpp>

#include <algorithm>
#include <limits>
#include <map>
#include <set>

namespace sprag
{
  using namespace dealii;

  namespace
  {
    // Nodes nearer than this share of the shortest side are taken for duplicates.
    constexpr double nearness = 1e-3;

    template <int dim>
    using Cell = typename Triangulation<dim>::active_cell_iterator;

    std::string group_name(const MeshGroups &groups, const types::material_id id)
    {
      for (const auto &[name, material] : groups.parts)
        if (material == id)
          return "'" + name + "'";
      return "";
    }

    /// A corner of the boundary, by its place along the lever.
    template <int dim>
    struct Corner
    {
      Point<dim> place;
      unsigned int index;
      types::material_id material;

      bool operator<(const Corner &other) const
      {
        return place[0] < other.place[0];
      }
    };

    template <int dim>
    std::vector<Corner<dim>> boundary_corners(const std::vector<BoundarySide<dim>> &boundary)
    {
      std::map<unsigned int, Corner<dim>> all;
      for (const auto &[side, cell] : boundary)
        for (const unsigned int v : side->vertex_indices())
          all.insert({ side->vertex_index(v), { side->vertex(v), side->vertex_index(v), cell->material_id() } });
      std::vector<Corner<dim>> result;
      for (const auto &[index, corner] : all)
        result.push_back(corner);
      std::sort(result.begin(), result.end());
      return result;
    }

    template <int dim>
    bool has_corner(const typename Triangulation<dim>::face_iterator &side, const unsigned int index)
    {
      const auto corners = side->vertex_indices();
      return std::any_of(corners.begin(), corners.end(), [&](const unsigned int v) { return side->vertex_index(v) == index; });
    }

    /// Twins of a node and nodes between those of a neighbour: where they lie, nothing is joined.
    template <int dim>
    void check_loose_nodes(const Triangulation<dim> &triangulation, const MeshGroups &groups, std::vector<std::string> &mistakes)
    {
      double shortest = std::numeric_limits<double>::max();
      for (const auto &cell : triangulation.active_cell_iterators())
        for (unsigned int line = 0; line < GeometryInfo<dim>::lines_per_cell; ++line)
          shortest = std::min(shortest, cell->line(line)->diameter());
      const double near   = nearness * shortest;
      const auto boundary = find_boundary(triangulation);
      const auto corners  = boundary_corners(boundary);
      std::map<unsigned int, std::string> loose; // by node
      for (const auto &[side, cell] : boundary)
      {
        auto box = side->bounding_box();
        box.extend(near);
        const auto [lower, upper] = box.get_boundary_points();
        auto corner               = std::lower_bound(corners.begin(), corners.end(), Corner<dim>{ lower, 0, 0 });
        for (; corner != corners.end() && corner->place[0] <= upper[0]; ++corner)
          if (box.point_inside(corner->place) && !has_corner<dim>(side, corner->index) &&
              GridTools::project_to_object(side, corner->place).distance(corner->place) < near)
            loose.insert({ corner->index, place_text(corner->place) + ", where " + group_name(groups, corner->material) +
                                              " touches " + group_name(groups, cell->material_id()) });
      }
      if (!loose.empty())
        mistakes.push_back(std::to_string(loose.size()) +
                           " nodes lie on a side of an element that they are no corners of, one at " + loose.begin()->second +
                           ": what touches must share its nodes, or it is not joined; in a .geo use 'Coherence;' or "
                           "'BooleanFragments' and the same number of nodes on both, in gmsh 'Remove duplicate nodes'");
    }

    /// Elements that are joined by sides, those of the hub left out.
    template <int dim>
    struct Part
    {
      Cell<dim> first;
      std::set<types::material_id> materials;
      bool is_held = false;
    };

    template <int dim>
    std::vector<Part<dim>> find_parts(const Triangulation<dim> &triangulation)
    {
      std::vector<bool> seen(triangulation.n_active_cells(), false);
      std::vector<Part<dim>> result;
      for (const auto &begin : triangulation.active_cell_iterators())
      {
        if (seen[begin->active_cell_index()] || begin->material_id() == material_id::hub)
          continue;
        Part<dim> part{ begin, {}, false };
        std::vector<Cell<dim>> open{ begin };
        seen[begin->active_cell_index()] = true;
        while (!open.empty())
        {
          const auto cell = open.back();
          open.pop_back();
          part.materials.insert(cell->material_id());
          for (const unsigned int f : cell->face_indices())
            if (cell->at_boundary(f))
              part.is_held = part.is_held || cell->face(f)->boundary_id() == boundary_id::hub;
            else if (const Cell<dim> next = cell->neighbor(f); next->material_id() == material_id::hub)
              part.is_held = true;
            else if (!seen[next->active_cell_index()])
            {
              seen[next->active_cell_index()] = true;
              open.push_back(next);
            }
        }
        result.push_back(part);
      }
      return result;
    }

    /// The plate is held by its sensors.
    template <int dim>
    void check_floating_parts(const Triangulation<dim> &triangulation, const MeshGroups &groups,
                              std::vector<std::string> &mistakes)
    {
      for (const auto &part : find_parts(triangulation))
      {
        const bool on_sensors = part.materials.count(material_id::plate) != 0;
        const bool is_lever   = part.materials.count(material_id::lever) != 0;
        std::set<std::string> names;
        for (const auto id : part.materials)
          names.insert(group_name(groups, id));
        const std::string it =
            "the part of " + boost::algorithm::join(names, ", ") + " with an element at " + place_text(part.first->center());
        if (!part.is_held && !on_sensors)
          mistakes.push_back(it + " floats: no sides of elements join it to 'hub' or to what that holds");
        else if (!is_lever && !on_sensors)
          mistakes.push_back(it + " shares no side of an element with 'lever', only with 'hub'");
      }
    }

    template <int dim>
    void check_reversed_face(const Triangulation<dim> &triangulation, std::vector<std::string> &mistakes)
    {
      for (const auto &[side, cell] : friction_face_sides(triangulation))
        if (!(cell->center()[1] > side->center()[1]))
        {
          mistakes.push_back("at " + place_text(side->center()) +
                             " the body lies on the cylinder's side of 'friction face', which comes from below; y runs from the "
                             "face into the lever");
          return;
        }
    }
  } // namespace

  template <int dim>
  std::vector<std::string> mesh_mistakes(const MeshGroups &groups, const Triangulation<dim> &triangulation)
  {
    std::vector<std::string> mistakes;
    check_loose_nodes(triangulation, groups, mistakes);
    check_floating_parts(triangulation, groups, mistakes);
    check_reversed_face(triangulation, mistakes);
    return mistakes;
  }

  template <int dim>
  double longest_face_side(const Triangulation<dim> &triangulation, const double first, const double last)
  {
    double longest = 0.;
    for (const auto &[side, cell] : friction_face_sides(triangulation))
      if (const auto [lower, upper] = side->bounding_box().get_boundary_points(); upper[0] > first && lower[0] < last)
        longest = std::max(longest, upper[0] - lower[0]);
    return longest;
  }

  template double longest_face_side(const Triangulation<2> &, double, double);
  template double longest_face_side(const Triangulation<3> &, double, double);
  template std::vector<std::string> mesh_mistakes(const MeshGroups &, const Triangulation<2> &);
  template std::vector<std::string> mesh_mistakes(const MeshGroups &, const Triangulation<3> &);
} // namespace sprag
