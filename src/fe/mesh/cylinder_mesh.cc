// SPDX-License-Identifier: GPL-3.0-only
#include "base/errors.h"
#include "base/text.h"
#include "fe/body/body_properties.h"
#include "fe/mesh/geometry_script.h"
#include "fe/mesh/mesh.h"
#include "scene/device.h"

#include <deal.II/grid/grid_tools.h>
#include <deal.II/grid/manifold_lib.h>

#include <tuple>

namespace sprag
{
  using namespace dealii;

  namespace
  {
    constexpr types::manifold_id circle = 1;

    /// A facetted circle would tilt friction and pressure with each of its sides.
    void check(const Device &device)
    {
      std::vector<std::string> mistakes;
      if (device.mesh.degree != 2)
        mistakes.push_back("Mesh/Degree = " + std::to_string(device.mesh.degree) +
                           ": an elastic cylinder (Cylinder/Type) needs elements of degree 2, which follow its surface");
      if (device.cylinder.inner_radius >= device.geometry.cylinder_radius)
        mistakes.push_back("Cylinder/Inner radius = " + mm(device.cylinder.inner_radius) +
                           " must be smaller than the cylinder's radius R = " + mm(device.geometry.cylinder_radius));
      if (!mistakes.empty())
        throw InputError(mistakes);
    }

    void append(const Triangulation<2> &part, std::vector<Point<2>> &vertices, std::vector<CellData<2>> &cells,
                SubCellData &boundary)
    {
      const auto first                        = static_cast<unsigned int>(vertices.size());
      auto [points, cell_data, boundary_data] = GridTools::get_coarse_mesh_description(part);
      vertices.insert(vertices.end(), points.begin(), points.end());
      for (auto &cell : cell_data)
      {
        for (auto &vertex : cell.vertices)
          vertex += first;
        cells.push_back(cell);
      }
      for (auto &line : boundary_data.boundary_lines)
      {
        for (auto &vertex : line.vertices)
          vertex += first;
        boundary.boundary_lines.push_back(line);
      }
    }
  } // namespace

  void add_cylinder(const Device &device, Triangulation<2> &triangulation)
  {
    check(device);
    const double radius     = device.geometry.cylinder_radius;
    const double face_width = 2. * (0.1 * radius + device.layer.thickness);
    const MeshGroups groups{ { { "cylinder", material_id::cylinder } },
                             { { "core", boundary_id::core }, { "cylinder face", boundary_id::cylinder_face } },
                             "'cylinder'" };
    Triangulation<2> cylinder;
    read_gmsh(mesh_script("cylinder.geo"),
              { { "radius", radius },
                { "inner_radius", device.cylinder.inner_radius },
                { "face_width", face_width },
                { "face_size", device.cylinder.face_size } },
              groups, cylinder);
    cylinder.set_all_manifold_ids(circle);

    // Both lie about their origins: none of their vertices are to become one.
    std::vector<Point<2>> vertices;
    std::vector<CellData<2>> cells;
    SubCellData boundary;
    append(triangulation, vertices, cells, boundary);
    append(cylinder, vertices, cells, boundary);
    triangulation.clear();
    triangulation.create_triangulation(vertices, cells, boundary);
    triangulation.set_manifold(circle, SphericalManifold<2>());
  }
} // namespace sprag
