#include "fe/mesh.h"

#include "base/errors.h"
#include "base/text.h"
#include "fe/elastic_body.h"
#include "scene/closed_form.h"

#include <deal.II/grid/grid_in.h>

#include <gmsh.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <unistd.h>

namespace sprag
{
  using namespace dealii;

  namespace
  {
    /// gmsh lives in one global session; this opens and closes it.
    class GmshSession
    {
    public:
      explicit GmshSession(const std::vector<std::string> &arguments)
      {
        std::vector<std::string> copy = arguments;
        std::vector<char *> argv;
        for (auto &argument : copy)
          argv.push_back(argument.data());
        gmsh::initialize(static_cast<int>(argv.size()), argv.data(), false);
      }
      GmshSession(const GmshSession &)            = delete;
      GmshSession &operator=(const GmshSession &) = delete;
      ~GmshSession()
      {
        gmsh::finalize();
      }
    };

    /// A file that is gone with its owner.
    class TemporaryFile
    {
    public:
      TemporaryFile()
          : path((std::filesystem::temp_directory_path() / ("sprag-" + std::to_string(::getpid()) + ".msh")).string())
      {
      }
      TemporaryFile(const TemporaryFile &)            = delete;
      TemporaryFile &operator=(const TemporaryFile &) = delete;
      ~TemporaryFile()
      {
        std::remove(path.c_str());
      }

      const std::string path;
    };

    struct GroupIds
    {
      std::map<int, types::material_id> materials;
      std::map<int, types::boundary_id> boundaries;
    };

    std::string quoted_list(const std::set<std::string> &names)
    {
      std::string text;
      for (const auto &name : names)
        text += (text.empty() ? "'" : ", '") + name + "'";
      return text.empty() ? "none" : text;
    }

    /// Physical tags by meaning. Reports everything that is missing or unknown at once.
    GroupIds read_groups(const std::string &file)
    {
      const std::map<std::string, types::material_id> surfaces = { { "lever", material_id::lever },
                                                                   { "layer", material_id::layer },
                                                                   { "hub", material_id::hub } };
      const std::map<std::string, types::boundary_id> curves   = { { "friction face", boundary_id::friction_face },
                                                                   { "hub", boundary_id::hub } };
      GroupIds ids;
      std::set<std::string> found[3];
      std::vector<std::string> mistakes;
      gmsh::vectorpair groups;
      gmsh::model::getPhysicalGroups(groups);
      for (const auto &[group_dim, tag] : groups)
      {
        std::string name;
        gmsh::model::getPhysicalName(group_dim, tag, name);
        if (group_dim == 2 && surfaces.count(name) != 0)
          ids.materials[tag] = surfaces.at(name);
        else if (group_dim == 1 && curves.count(name) != 0)
          ids.boundaries[tag] = curves.at(name);
        else if (group_dim == 2)
          mistakes.push_back(file + ": unknown physical surface '" + name +
                             "': surfaces are 'lever', 'layer' (optional) and 'hub' (optional)");
        if (group_dim == 1 || group_dim == 2)
          found[group_dim].insert(name);
      }
      if (found[1].count("friction face") == 0)
        mistakes.push_back(file + ": no physical curve 'friction face', where the cylinder slides (curves found: " +
                           quoted_list(found[1]) + ")");
      if (found[2].count("lever") == 0)
        mistakes.push_back(file + ": no physical surface 'lever', the metal (surfaces found: " + quoted_list(found[2]) + ")");
      if (found[1].count("hub") + found[2].count("hub") == 0)
        mistakes.push_back(file + ": no physical curve or surface 'hub', which carries the lever on its pivot");
      if (!mistakes.empty())
        throw InputError(mistakes);
      return ids;
    }

    void refuse_other_elements(const std::string &file)
    {
      std::vector<int> types;
      std::vector<std::vector<std::size_t>> tags, nodes;
      gmsh::model::mesh::getElements(types, tags, nodes, 2);
      const int quadrilateral = gmsh::model::mesh::getElementType("quadrangle", 1);
      for (const int type : types)
        if (type != quadrilateral)
          throw InputError(file + ": the mesh has elements other than 4-node quadrilaterals; in a .geo use "
                                  "'Recombine Surface', and no high-order meshes (the polynomial degree is Mesh/Degree)");
      if (types.empty())
        throw InputError(file + ": the mesh has no elements in a physical surface");
    }

    /// Part of the friction face under the cylinder during the drive, with room for the contact's width [mm].
    std::array<double, 2> swept_face(const Scene &scene)
    {
      const double room    = 0.1 * scene.geometry.cylinder_radius;
      const double nearest = kinematics(scene.geometry, scene.drive.maximum()).s - room;
      const double largest = kinematics(scene.geometry, scene.drive.minimum()).s + room;
      return { { std::max(nearest, scene.mesh.face_size), std::min(largest, scene.lever.length - scene.mesh.face_size) } };
    }

    std::vector<std::string> built_in_arguments(const Scene &scene)
    {
      const auto sweep                                             = swept_face(scene);
      const std::vector<std::pair<const char *, double>> constants = { { "lever_length", scene.lever.length },
                                                                       { "lever_depth", scene.lever.depth },
                                                                       { "offset", scene.geometry.interface_offset },
                                                                       { "layer_thickness", scene.layer.thickness },
                                                                       { "hub_length", 0.5 * scene.lever.depth },
                                                                       { "largest", 0.15 * scene.lever.depth },
                                                                       { "face_size", scene.mesh.face_size },
                                                                       { "sweep_begin", sweep[0] },
                                                                       { "sweep_end", sweep[1] } };
      std::vector<std::string> arguments                           = { "sprag" };
      for (const auto &[name, value] : constants)
      {
        char number[32];
        std::snprintf(number, sizeof(number), "%.17g", value);
        arguments.insert(arguments.end(), { "-setnumber", name, number });
      }
      return arguments;
    }

    /// Runs gmsh and leaves its mesh in `output`.
    GroupIds run_gmsh(const Scene &scene, const std::string &output)
    {
      const bool built_in    = scene.mesh.file.empty();
      const std::string file = built_in ? SPRAG_MESHES "/lever.geo" : scene.mesh.file;
      if (!std::ifstream(file))
        throw InputError(file + ": the mesh file cannot be read");
      const GmshSession session(built_in ? built_in_arguments(scene) : std::vector<std::string>{ "sprag" });
      gmsh::option::setNumber("General.Terminal", 0);
      gmsh::option::setNumber("Mesh.MshFileVersion", 2.2);
      try
      {
        gmsh::open(file);
        std::vector<std::size_t> nodes;
        std::vector<double> positions, parametric;
        gmsh::model::mesh::getNodes(nodes, positions, parametric);
        if (nodes.empty())
          gmsh::model::mesh::generate(2);
        const GroupIds ids = read_groups(file);
        refuse_other_elements(file);
        gmsh::write(output);
        return ids;
      }
      catch (const InputError &)
      {
        throw;
      }
      catch (...)
      {
        std::string error;
        gmsh::logger::getLastError(error);
        throw InputError(file + ": gmsh cannot mesh it: " + error);
      }
    }

    void rename_ids(const GroupIds &ids, Triangulation<2> &triangulation)
    {
      for (const auto &cell : triangulation.active_cell_iterators())
      {
        cell->set_material_id(ids.materials.at(static_cast<int>(cell->material_id())));
        for (const auto &face : cell->face_iterators())
          if (face->at_boundary())
          {
            const auto id = ids.boundaries.find(static_cast<int>(face->boundary_id()));
            face->set_boundary_id(id == ids.boundaries.end() ? 0 : id->second);
          }
      }
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

    void read(const std::string &file, std::istream &stream, Triangulation<2> &triangulation)
    {
      try
      {
        GridIn<2> reader(triangulation);
        reader.read_msh(stream);
      }
      catch (const dealii::ExceptionBase &)
      {
        throw InputError(file +
                         ": the mesh cannot be used: a surface is in two physical groups, a physical curve lies inside the " +
                         "body, or cells do not match along a common side");
      }
    }
  } // namespace

  void make_mesh(const Scene &scene, Triangulation<2> &triangulation)
  {
    const TemporaryFile output;
    const GroupIds ids = run_gmsh(scene, output.path);
    std::ifstream stream(output.path);
    read(scene.mesh.file, stream, triangulation);
    rename_ids(ids, triangulation);
    check_position(scene, triangulation);
  }
} // namespace sprag
