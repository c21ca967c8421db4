#include "fe/mesh.h"

#include "base/errors.h"
#include "base/text.h"
#include "fe/cylinder_mesh.h"
#include "fe/elastic_body.h"
#include "fe/geometry_script.h"
#include "scene/closed_form.h"

#include <algorithm>
#include <cmath>

namespace sprag
{
  using namespace dealii;

  namespace
  {
    using Names = std::set<std::string>;

    std::vector<std::string> missing_groups(const Names &surfaces, const Names &curves)
    {
      std::vector<std::string> result;
      if (curves.count("friction face") == 0)
        result.push_back("no physical curve 'friction face', where the cylinder slides (curves found: " + quoted_list(curves) +
                         ")");
      if (surfaces.count("lever") == 0)
        result.push_back("no physical surface 'lever', the metal (surfaces found: " + quoted_list(surfaces) + ")");
      if (curves.count("hub") + surfaces.count("hub") == 0)
        result.push_back("no physical curve or surface 'hub', which carries the lever on its pivot");
      return result;
    }

    MeshGroups lever_groups()
    {
      return { { { "lever", material_id::lever }, { "layer", material_id::layer }, { "hub", material_id::hub } },
               { { "friction face", boundary_id::friction_face }, { "hub", boundary_id::hub } },
               "'lever', 'layer' (optional) and 'hub' (optional)",
               missing_groups };
    }

    /// Part of the friction face under the cylinder during the drive, with room for the contact's width [mm].
    std::array<double, 2> swept_face(const Scene &scene)
    {
      const double room    = 0.1 * scene.geometry.cylinder_radius;
      const double nearest = kinematics(scene.geometry, scene.drive.maximum()).s - room;
      const double largest = kinematics(scene.geometry, scene.drive.minimum()).s + room;
      return { { std::max(nearest, scene.mesh.face_size), std::min(largest, scene.lever.length - scene.mesh.face_size) } };
    }

    std::vector<std::pair<std::string, double>> bar_constants(const Scene &scene)
    {
      const auto sweep = swept_face(scene);
      return { { "lever_length", scene.lever.length },
               { "lever_depth", scene.lever.depth },
               { "offset", scene.geometry.interface_offset },
               { "layer_thickness", scene.layer.thickness },
               { "hub_length", 0.5 * scene.lever.depth },
               { "largest", 0.15 * scene.lever.depth },
               { "face_size", scene.mesh.face_size },
               { "sweep_begin", sweep[0] },
               { "sweep_end", sweep[1] } };
    }

    /// Bounding box of the friction face, empty if lower > upper.
    struct FaceExtent
    {
      Point<2> lower{ std::numeric_limits<double>::max(), std::numeric_limits<double>::max() };
      Point<2> upper{ std::numeric_limits<double>::lowest(), std::numeric_limits<double>::lowest() };
    };

    FaceExtent extent_of_friction_face(const Triangulation<2> &triangulation)
    {
      FaceExtent extent;
      for (const auto &cell : triangulation.active_cell_iterators())
        for (const auto &face : cell->face_iterators())
          if (face->at_boundary() && face->boundary_id() == boundary_id::friction_face)
            for (unsigned int v = 0; v < 2; ++v)
              for (unsigned int d = 0; d < 2; ++d)
              {
                extent.lower[d] = std::min(extent.lower[d], face->vertex(v)[d]);
                extent.upper[d] = std::max(extent.upper[d], face->vertex(v)[d]);
              }
      return extent;
    }

    /// The face must lie where the scene's geometry has it, or the cylinder would miss it.
    void check_position(const Scene &scene, const Triangulation<2> &triangulation)
    {
      const auto extent    = extent_of_friction_face(triangulation);
      const auto &geometry = scene.geometry;
      const auto &file     = scene.mesh.file;
      const double e       = geometry.interface_offset;
      const double small   = 1e-6 * geometry.cylinder_radius;
      if (extent.lower[0] > extent.upper[0])
        throw InputError(file + ": no side of 'lever' or 'layer' lies on the curve 'friction face'");

      std::vector<std::string> mistakes;
      if (extent.lower[1] < e - small || extent.upper[1] > e + small)
        mistakes.push_back(file + ": the curve 'friction face' lies " + rounded_text(extent.lower[1]) + " to " +
                           rounded_text(extent.upper[1]) +
                           " mm off the pivot, but Geometry/Interface offset = " + rounded_text(e));
      const double first = kinematics(geometry, scene.drive.maximum()).s;
      const double last  = kinematics(geometry, scene.drive.minimum()).s;
      if (extent.lower[0] > first || extent.upper[0] < last)
        mistakes.push_back(file + ": the curve 'friction face' spans " + rounded_text(extent.lower[0]) + " to " +
                           rounded_text(extent.upper[0]) + " mm from the pivot, but the contact sweeps " + rounded_text(first) +
                           " to " + rounded_text(last) + " mm");
      if (!mistakes.empty())
        throw InputError(mistakes);
    }

  } // namespace

  void make_mesh(const Scene &scene, Triangulation<2> &triangulation)
  {
    if (scene.mesh.file.empty())
      read_gmsh(mesh_script("lever.geo"), bar_constants(scene), lever_groups(), triangulation);
    else
      read_gmsh(scene.mesh.file, {}, lever_groups(), triangulation);
    check_position(scene, triangulation);
    if (scene.cylinder.type != CylinderType::rigid)
      add_cylinder(scene, triangulation);
  }
} // namespace sprag
