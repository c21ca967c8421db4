// SPDX-License-Identifier: GPL-3.0-only
#include "fe/statics/solid_body.h"

#include "base/errors.h"
#include "base/messages.h"
#include "fe/body/body_properties.h"
#include "fe/mesh/solid_file.h"
#include "scene/device.h"
#include "scene/lever_shape.h"

#include <deal.II/grid/grid_tools.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

namespace sprag
{
  using namespace dealii;

  template <int dim>
  void serialise(Archive &archive, CellData<dim> &cell)
  {
    archive(cell.vertices, cell.material_id, cell.manifold_id);
  }

  namespace
  {
    /// Vertices, cells, and the sides that have an id.
    using Description = std::tuple<std::vector<Point<3>>, std::vector<CellData<3>>, std::vector<CellData<2>>>;

    /// Builds one mesh of the layers of another.
    struct Extrusion
    {
      std::vector<double> planes;
      double web; ///< width [mm]
      std::vector<Point<2>> vertices;
      std::vector<CellData<2>> cells;
      std::vector<CellData<1>> lines;

      unsigned int n_layers() const
      {
        return static_cast<unsigned int>(planes.size()) - 1;
      }

      unsigned int vertex(const unsigned int in_plane, const unsigned int plane) const
      {
        return in_plane + plane * static_cast<unsigned int>(vertices.size());
      }

      bool is_there(const types::material_id material, const unsigned int layer) const
      {
        return material != material_id::web || std::abs(planes[layer] + planes[layer + 1]) < web;
      }

      void add_side(const std::array<unsigned int, 4> &corners, const types::boundary_id id, Description &result) const
      {
        auto &side       = std::get<2>(result).emplace_back();
        side.boundary_id = id;
        std::copy(corners.begin(), corners.end(), side.vertices.begin());
      }

      void add_cells(Description &result) const
      {
        for (const auto &cell : cells)
          for (unsigned int layer = 0; layer < n_layers(); ++layer)
            if (is_there(cell.material_id, layer))
            {
              auto &added       = std::get<1>(result).emplace_back();
              added.material_id = cell.material_id;
              for (unsigned int v = 0; v < 4; ++v)
              {
                added.vertices[v]     = vertex(cell.vertices[v], layer);
                added.vertices[v + 4] = vertex(cell.vertices[v], layer + 1);
              }
            }
      }

      std::map<std::pair<unsigned int, unsigned int>, types::material_id> side_materials() const
      {
        std::map<std::pair<unsigned int, unsigned int>, types::material_id> result;
        for (const auto &cell : cells)
          for (const auto &[a, b] : { std::pair(0, 1), std::pair(0, 2), std::pair(1, 3), std::pair(2, 3) })
            result[std::minmax(cell.vertices[a], cell.vertices[b])] = cell.material_id;
        return result;
      }

      void add_sides(Description &result) const
      {
        const auto materials = side_materials();
        for (const auto &line : lines)
          for (unsigned int layer = 0; layer < n_layers(); ++layer)
          {
            const auto [a, b] = std::pair(line.vertices[0], line.vertices[1]);
            if (line.boundary_id != 0 && is_there(materials.at(std::minmax(a, b)), layer))
              add_side({ { vertex(a, layer), vertex(b, layer), vertex(a, layer + 1), vertex(b, layer + 1) } }, line.boundary_id,
                       result);
          }
        if (planes.front() == 0.)
          for (const auto &cell : cells)
            add_side({ { cell.vertices[0], cell.vertices[1], cell.vertices[2], cell.vertices[3] } }, boundary_id::symmetry,
                     result);
      }

      Description operator()() const
      {
        Description result;
        for (const double zeta : planes)
          for (const auto &place : vertices)
            std::get<0>(result).emplace_back(place[0], place[1], zeta);
        add_cells(result);
        add_sides(result);
        return result;
      }
    };

    Description extruded(const Device &device, const Mesh &plane)
    {
      const auto [vertices, cells, boundary] = GridTools::get_coarse_mesh_description(plane);
      const auto is_web                      = [](const CellData<2> &cell) { return cell.material_id == material_id::web; };
      const bool has_web                     = std::any_of(cells.begin(), cells.end(), is_web);
      const double web                       = device.frame.web;
      const auto planes                      = planes_across(device);
      return Extrusion{ has_web ? with_web_sides(web, planes) : planes, web, vertices, cells, boundary.boundary_lines }();
    }

    Description read(const Device &device)
    {
      Triangulation<3> triangulation;
      read_solid_file(device, triangulation);
      const auto [vertices, cells, boundary] = GridTools::get_coarse_mesh_description(triangulation);
      return { vertices, cells, boundary.boundary_quads };
    }

    /// Message of the first rank to all: the mesh, or its mistakes.
    struct Handed
    {
      Description description;
      bool is_half = false;
      std::vector<std::string> mistakes;
    };

    void serialise(Archive &archive, Handed &handed)
    {
      auto &[vertices, cells, sides] = handed.description;
      archive(vertices, cells, sides, handed.is_half, handed.mistakes);
    }

    Handed made(const Device &device, const Mesh &plane)
    {
      if (plane.n_active_cells() > 0)
        return { extruded(device, plane), is_symmetric_across(device), {} };
      try
      {
        return { read(device), false, {} };
      }
      catch (const InputError &error)
      {
        return { {}, false, error.messages };
      }
    }

    /// Makes the mesh of the first rank's description on all ranks. Returns whether it is a half.
    bool create(Handed first_data, SolidMesh &mesh)
    {
      auto handed = broadcast(mesh.get_communicator(), std::move(first_data));
      if (!handed.mistakes.empty())
        throw InputError(handed.mistakes);
      auto &[vertices, cells, sides] = handed.description;
      SubCellData boundary;
      boundary.boundary_quads = std::move(sides);
      GridTools::delete_unused_vertices(vertices, cells, boundary);
      mesh.create_triangulation(vertices, cells, boundary);
      return handed.is_half;
    }
  } // namespace

  bool make_solid_mesh(const Device &device, const Mesh &plane, SolidMesh &mesh)
  {
    return create(made(device, plane), mesh);
  }

  bool receive_solid_mesh(SolidMesh &mesh)
  {
    return create({}, mesh);
  }
} // namespace sprag
