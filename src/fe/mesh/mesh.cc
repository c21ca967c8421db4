#include "fe/mesh/mesh.h"

#include "base/append.h"
#include "base/errors.h"
#include "base/text.h"
#include "fe/body/elastic_body.h"
#include "fe/mesh/geometry_script.h"
#include "fe/mesh/solid_file.h"
#include "scene/contact_width.h"
#include "scene/lever_shape.h"

#include <deal.II/base/bounding_box.h>

#include <algorithm>
#include <cmath>

namespace sprag
{
  using namespace dealii;

  namespace
  {
    using Names = std::set<std::string>;

    /// What a friction plate needs besides.
    const std::pair<const char *, const char *> plate_curves[] = { { "sensor plate", "its back, towards the sensors" },
                                                                   { "sensor lever", "the lever's side towards the sensors" } };

    std::vector<std::string> missing_of_plate(const bool wanted, const Names &surfaces, const Names &curves)
    {
      if (!wanted)
        return surfaces.count("plate") == 0 ? std::vector<std::string>{}
                                            : std::vector<std::string>{ "has a surface 'plate', but Friction plate/Type = none" };
      std::vector<std::string> result;
      const std::string wish = "Friction plate/Type = on sensors, but there is no physical ";
      if (surfaces.count("plate") == 0)
        result.push_back(wish + "surface 'plate' (surfaces found: " + quoted_list(surfaces) + ")");
      for (const auto &[name, meaning] : plate_curves)
        if (curves.count(name) == 0)
          result.push_back(wish + "curve '" + name + "', " + meaning + " (curves found: " + quoted_list(curves) + ")");
      return result;
    }

    std::vector<std::string> missing_groups(const Scene &scene, const Names &surfaces, const Names &curves)
    {
      std::vector<std::string> result;
      if (curves.count("friction face") == 0)
        result.push_back("no physical curve 'friction face', where the cylinder slides (curves found: " + quoted_list(curves) +
                         ")");
      if (surfaces.count("lever") == 0)
        result.push_back("no physical surface 'lever', the metal (surfaces found: " + quoted_list(surfaces) + ")");
      if (curves.count("hub") + surfaces.count("hub") == 0)
        result.push_back("no physical curve or surface 'hub', which carries the lever on its pivot");
      if (surfaces.count("web") != 0 && scene.frame.web == 0.)
        result.push_back("has a surface 'web', which must be wider than Lever frame/Web = 0");
      return joined(result, missing_of_plate(scene.plate.type == PlateType::on_sensors, surfaces, curves));
    }

    MeshGroups lever_groups(const Scene &scene)
    {
      return { { { "lever", material_id::lever },
                 { "web", material_id::web },
                 { "plate", material_id::plate },
                 { "layer", material_id::layer },
                 { "hub", material_id::hub } },
               { { "friction face", boundary_id::friction_face },
                 { "hub", boundary_id::hub },
                 { "sensor plate", boundary_id::sensor_plate },
                 { "sensor lever", boundary_id::sensor_lever } },
               "'lever', 'web', 'plate', 'layer' and 'hub' (all but 'lever' optional)",
               [&scene](const Names &surfaces, const Names &curves) { return missing_groups(scene, surfaces, curves); } };
    }

    /// Part of the friction face under the cylinder during the drive, with room for the contact's width [mm].
    std::array<double, 2> swept_face(const Scene &scene)
    {
      const double room        = 0.1 * scene.geometry.cylinder_radius;
      const auto [first, last] = swept_contact(scene);
      const auto [begin, end]  = friction_face(scene);
      const double size        = scene.mesh.face_size;
      return { { std::max(first - room, std::min(begin + size, first)), std::min(last + room, std::max(end - size, last)) } };
    }

    MeshConstants common_constants(const Scene &scene)
    {
      const auto sweep = swept_face(scene);
      return { { "lever_length", scene.lever.length },
               { "offset", scene.geometry.interface_offset },
               { "layer_thickness", scene.layer.thickness },
               { "plate_thickness", scene.plate.type == PlateType::none ? 0. : scene.plate.thickness },
               { "plate_begin", scene.plate.begin },
               { "plate_end", scene.plate.end },
               { "spacer", scene.plate.spacer },
               { "largest", 0.15 * scene.lever.depth },
               { "face_size", scene.mesh.face_size },
               { "sweep_begin", sweep[0] },
               { "sweep_end", sweep[1] } };
    }

    MeshConstants bar_constants(const Scene &scene)
    {
      const auto grading = face_grading(scene).value_or(FaceGrading{});
      return joined(common_constants(scene), { { "lever_depth", scene.lever.depth },
                                               { "hub_length", 0.5 * scene.lever.depth },
                                               { "graded_from", grading.begin },
                                               { "graded_to", grading.end },
                                               { "longest", grading.longest },
                                               { "shortest", grading.shortest } });
    }

    MeshConstants frame_constants(const Scene &scene)
    {
      return joined(common_constants(scene), { { "root_depth", scene.lever.depth },
                                               { "tip_depth", scene.frame.tip_depth },
                                               { "flange", scene.frame.flange },
                                               { "web", scene.frame.web },
                                               { "pockets", scene.frame.pockets },
                                               { "rib", scene.frame.rib },
                                               { "root", scene.frame.root },
                                               { "hub_radius", frame_hub_radius },
                                               { "wall", frame_wall } });
    }

    std::vector<Point<2>> corners_of_friction_face(const Triangulation<2> &triangulation)
    {
      std::vector<Point<2>> corners;
      for (const auto &cell : triangulation.active_cell_iterators())
        for (const auto &face : cell->face_iterators())
          if (face->at_boundary() && face->boundary_id() == boundary_id::friction_face)
            corners.insert(corners.end(), { face->vertex(0), face->vertex(1) });
      return corners;
    }

    /// The face must lie where the scene's geometry has it, or the cylinder would miss it.
    void check_position(const Scene &scene, const Triangulation<2> &triangulation)
    {
      const auto corners   = corners_of_friction_face(triangulation);
      const auto &geometry = scene.geometry;
      const auto &file     = scene.mesh.file;
      const double e       = geometry.interface_offset;
      const double small   = 1e-6 * geometry.cylinder_radius;
      if (corners.empty())
        throw InputError(file + ": no side of 'lever' or 'layer' lies on the curve 'friction face'");
      const auto [lower, upper] = BoundingBox<2>(corners).get_boundary_points();

      std::vector<std::string> mistakes;
      if (lower[1] < e - small || upper[1] > e + small)
        mistakes.push_back(file + ": the curve 'friction face' lies " + rounded_text(lower[1]) + " to " + mm(upper[1]) +
                           " off the pivot, but Geometry/Interface offset = " + rounded_text(e));
      const auto [first, last] = swept_contact(scene);
      if (lower[0] > first || upper[0] < last)
        mistakes.push_back(file + ": the curve 'friction face' spans " + rounded_text(lower[0]) + " to " + mm(upper[0]) +
                           " from the pivot, but the contact sweeps " + rounded_text(first) + " to " + mm(last));
      if (!mistakes.empty())
        throw InputError(mistakes);
    }
  } // namespace

  void make_mesh(const Scene &scene, Triangulation<2> &triangulation)
  {
    if (has_solid_file(scene))
      return;
    if (!scene.mesh.file.empty())
      read_gmsh(scene.mesh.file, {}, lever_groups(scene), triangulation);
    else if (scene.lever.outline == LeverOutline::bar)
      read_gmsh(mesh_script("lever.geo"), bar_constants(scene), lever_groups(scene), triangulation);
    else
      read_gmsh(mesh_script("frame.geo"), frame_constants(scene), lever_groups(scene), triangulation);
    check_position(scene, triangulation);
    if (scene.cylinder.type != CylinderType::rigid)
      add_cylinder(scene, triangulation);
  }
} // namespace sprag
