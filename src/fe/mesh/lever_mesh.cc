// SPDX-License-Identifier: GPL-3.0-only
#include "fe/mesh/lever_mesh.h"

#include "base/errors.h"
#include "base/ranges.h"
#include "base/text.h"
#include "fe/body/body_properties.h"
#include "fe/body/elastic_body.h"
#include "fe/mesh/mesh_checks.h"
#include "fe/mesh/solid_file.h"
#include "scene/contact_estimates.h"
#include "scene/device.h"
#include "scene/lever_shape.h"

#include <deal.II/base/bounding_box.h>
#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/grid_tools.h>
#include <deal.II/grid/manifold_lib.h>

#include <algorithm>
#include <cmath>
#include <tuple>

namespace sprag
{
  using namespace dealii;

  namespace
  {
    using Names    = std::set<std::string>;
    using Messages = std::vector<std::string>;

    struct LeverGroup
    {
      std::string name;
      std::string meaning;
    };

    /// Groups of one kind that a mesh has.
    struct Found
    {
      std::string kind; ///< "surface"
      const Names &names;

      bool has(const std::string &name) const
      {
        return names.count(name) != 0;
      }
    };

    /// Adds "no physical surface 'name', meaning (surfaces found: ...)" if the mesh lacks the group.
    void need(const LeverGroup &group, const Found &found, Messages &result, const std::string &wish = "")
    {
      const auto &[name, meaning] = group;
      if (!found.has(name))
        result.push_back(wish + "no physical " + found.kind + " '" + name + "', " + meaning + " (" + found.kind +
                         "s found: " + quoted_list(found.names) + ")" +
                         did_you_mean(nearest(name, { found.names.begin(), found.names.end() })));
    }

    Messages missing_groups(const Device &device, const Found &parts, const Found &sides)
    {
      Messages result;
      need({ "friction face", "where the cylinder slides" }, sides, result);
      need({ "lever", "the metal" }, parts, result);
      if (!parts.has("hub"))
        need({ "hub", "which carries the lever on its pivot, nor a " + parts.kind + " 'hub'" }, sides, result);
      if (parts.has("web") && device.frame.web == 0.)
        result.push_back("has a " + parts.kind + " 'web', which must be wider than Lever frame/Web = 0");
      if (device.plate.type == PlateType::none)
      {
        if (parts.has("plate"))
          result.push_back("has a " + parts.kind + " 'plate', but Friction plate/Type = none");
        return result;
      }
      const std::string wish = "Friction plate/Type = on sensors, but there is ";
      need({ "plate", "which the cylinder rubs against" }, parts, result, wish);
      need({ "sensor plate", "the back of the friction plate, towards the sensors" }, sides, result, wish);
      need({ "sensor lever", "the lever's side towards the sensors" }, sides, result, wish);
      return result;
    }
  } // namespace

  MeshGroups lever_groups(const Device &device, const int dimension)
  {
    const bool plane = dimension == 2; // in which a web is a part of its own width
    MeshGroups result;
    result.parts = { { "lever", material_id::lever },
                     { "plate", material_id::plate },
                     { "layer", material_id::layer },
                     { "hub", material_id::hub } };
    if (plane)
      result.parts.emplace("web", material_id::web);
    result.sides = { { "friction face", boundary_id::friction_face },
                     { "hub", boundary_id::hub },
                     { "sensor plate", boundary_id::sensor_plate },
                     { "sensor lever", boundary_id::sensor_lever } };
    result.part_names =
        std::string("'lever', ") + (plane ? "'web', " : "") + "'plate', 'layer' and 'hub' (all but 'lever' optional)";
    result.missing = [&device, plane](const Names &parts, const Names &sides) {
      return missing_groups(device, Found{ plane ? "surface" : "volume", parts }, Found{ plane ? "curve" : "surface", sides });
    };
    return result;
  }

  namespace
  {
    /// Part of the friction face under the cylinder during the drive, with a margin for the contact's width [mm].
    std::array<double, 2> swept_face(const Device &device)
    {
      const auto [from, to]    = contact_surroundings(device);
      const auto [first, last] = swept_contact(device);
      const auto [begin, end]  = friction_face(device);
      const double size        = device.mesh.face_size;
      return { { std::max(from, std::min(begin + size, first)), std::min(to, std::max(end - size, last)) } };
    }

    MeshConstants common_constants(const Device &device)
    {
      const auto sweep = swept_face(device);
      return { { "lever_length", device.lever.length },
               { "offset", device.geometry.interface_offset },
               { "layer_thickness", device.layer.thickness },
               { "plate_thickness", device.plate.type == PlateType::none ? 0. : device.plate.thickness },
               { "plate_begin", device.plate.begin },
               { "plate_end", device.plate.end },
               { "spacer", device.plate.spacer },
               { "largest", 0.15 * device.lever.depth },
               { "face_size", device.mesh.face_size },
               { "sweep_begin", sweep[0] },
               { "sweep_end", sweep[1] } };
    }

    MeshConstants bar_constants(const Device &device)
    {
      const auto grading = face_grading(device).value_or(FaceGrading{});
      return joined(common_constants(device), { { "lever_depth", device.lever.depth },
                                                { "hub_length", 0.5 * device.lever.depth },
                                                { "graded_from", grading.begin },
                                                { "graded_to", grading.end },
                                                { "longest", grading.longest },
                                                { "shortest", grading.shortest } });
    }

    MeshConstants frame_constants(const Device &device)
    {
      return joined(common_constants(device), { { "root_depth", device.lever.depth },
                                                { "tip_depth", device.frame.tip_depth },
                                                { "flange", device.frame.flange },
                                                { "web", device.frame.web },
                                                { "pockets", device.frame.pockets },
                                                { "rib", device.frame.rib },
                                                { "root", device.frame.root },
                                                { "hub_radius", frame_hub_radius },
                                                { "wall", frame_wall } });
    }

    /// Ends of the sides on the friction face, from the pivot on.
    std::vector<std::array<Point<2>, 2>> side_ends(const Triangulation<2> &triangulation)
    {
      std::vector<std::array<Point<2>, 2>> result;
      for (const auto &[side, cell] : friction_face_sides(triangulation))
      {
        const Point<2> &a = side->vertex(0), &b = side->vertex(1);
        result.push_back({ { a[0] < b[0] ? a : b, a[0] < b[0] ? b : a } });
      }
      std::sort(result.begin(), result.end(), [](const auto &one, const auto &other) { return one[0][0] < other[0][0]; });
      return result;
    }

    constexpr unsigned int most_halved = 100000; ///< elements of a halved mesh, which take about 2 GB with degree 2

    /// Cuts each element in four. The result has one level of refinement, as a mesh that was read.
    void halve_elements(const std::string &file, Triangulation<2> &triangulation)
    {
      if (4 * triangulation.n_active_cells() > most_halved)
        throw AnalysisError(file + " would have more than " + std::to_string(most_halved) + " elements with sides half as long");
      Triangulation<2> halved;
      halved.copy_triangulation(triangulation);
      halved.refine_global(1);
      triangulation.clear();
      GridGenerator::flatten_triangulation(halved, triangulation);
    }

    /// The face must lie where the scene's geometry has it, or the cylinder would miss it.
    std::vector<std::string> face_mistakes(const Device &device, const Triangulation<2> &triangulation)
    {
      const auto sides     = side_ends(triangulation);
      const auto &geometry = device.geometry;
      const auto &file     = device.mesh.file;
      const double e       = geometry.interface_offset;
      const double small   = 1e-6 * geometry.cylinder_radius;
      if (sides.empty())
        throw InputError(file + ": no side of 'lever' or 'layer' lies on the curve 'friction face'");
      std::vector<Point<2>> corners;
      for (const auto &[begin, end] : sides)
        corners.insert(corners.end(), { begin, end });
      const auto [lower, upper] = BoundingBox<2>(corners).get_boundary_points();

      std::vector<std::string> mistakes;
      if (lower[1] < e - small || upper[1] > e + small)
        mistakes.push_back(file + ": the curve 'friction face' lies " + rounded_text(lower[1]) + " to " + mm(upper[1]) +
                           " off the pivot, but Geometry/Interface offset = " + rounded_text(e));
      const auto [first, last] = swept_contact(device);
      if (lower[0] > first || upper[0] < last)
        mistakes.push_back(file + ": the curve 'friction face' spans " + rounded_text(lower[0]) + " to " + mm(upper[0]) +
                           " from the pivot, but the contact sweeps " + rounded_text(first) + " to " + mm(last));
      double covered = sides.front()[0][0];
      for (const auto &[begin, end] : sides)
      {
        if (begin[0] > covered + small && begin[0] > first && covered < last)
        {
          mistakes.push_back(file + ": the curve 'friction face' lacks a piece from " + rounded_text(covered) + " to " +
                             mm(begin[0]) + " from the pivot, but the contact sweeps " + rounded_text(first) + " to " + mm(last));
          break;
        }
        covered = std::max(covered, end[0]);
      }
      return mistakes;
    }
  } // namespace

  void make_mesh(const Device &device, Triangulation<2> &triangulation)
  {
    if (has_solid_file(device))
      return;
    const auto groups = lever_groups(device, 2);
    std::vector<std::string> mistakes;
    if (!device.mesh.file.empty())
    {
      read_gmsh(device.mesh.file, {}, groups, triangulation);
      for (const auto &mistake : mesh_mistakes(groups, triangulation))
        mistakes.push_back(device.mesh.file + ": " + mistake);
      if (device.analysis.dimension == 3)
        if (const auto too_short = cylinder_too_short(device, planes_across(device)); !too_short.empty())
          mistakes.push_back(device.mesh.file + ": Cylinder/Length = " + rounded_text(device.cylinder.length) + " " + too_short);
      for (unsigned int i = 0; i < device.mesh.halvings; ++i)
        halve_elements(device.mesh.file, triangulation);
    }
    else if (device.lever.outline == LeverOutline::bar)
      read_gmsh(mesh_script("lever.geo"), bar_constants(device), groups, triangulation);
    else
      read_gmsh(mesh_script("frame.geo"), frame_constants(device), groups, triangulation);
    append(mistakes, face_mistakes(device, triangulation));
    if (!mistakes.empty())
      throw InputError(mistakes);
    if (device.cylinder.type != CylinderType::rigid)
      add_cylinder(device, triangulation);
  }

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
