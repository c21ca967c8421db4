#include "fe/geometry_script.h"

#include "base/errors.h"
#include "base/text.h"

#include <deal.II/grid/grid_in.h>

#include <gmsh.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
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

    /// Physical tags by meaning. Reports everything that is missing or unknown at once.
    GroupIds read_groups(const std::string &file, const MeshGroups &groups)
    {
      GroupIds ids;
      std::set<std::string> surfaces, curves;
      std::vector<std::string> mistakes;
      gmsh::vectorpair tags;
      gmsh::model::getPhysicalGroups(tags);
      for (const auto &[group_dim, tag] : tags)
      {
        std::string name;
        gmsh::model::getPhysicalName(group_dim, tag, name);
        if (group_dim == 2 && groups.surfaces.count(name) != 0)
          ids.materials[tag] = groups.surfaces.at(name);
        else if (group_dim == 1 && groups.curves.count(name) != 0)
          ids.boundaries[tag] = groups.curves.at(name);
        else if (group_dim == 2)
          mistakes.push_back(file + ": unknown physical surface '" + name + "': surfaces are " + groups.surface_names);
        if (group_dim == 2)
          surfaces.insert(name);
        else if (group_dim == 1)
          curves.insert(name);
      }
      for (const auto &line : groups.missing(surfaces, curves))
        mistakes.push_back(file + ": " + line);
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

    /// A plane lever's mesh lies in z = 0: another would be read as its shadow.
    void refuse_third_dimension(const std::string &file)
    {
      std::vector<int> types;
      std::vector<std::vector<std::size_t>> tags, corners;
      gmsh::model::mesh::getElements(types, tags, corners, 3);
      gmsh::vectorpair volumes;
      gmsh::model::getEntities(volumes, 3);
      if (!types.empty() || !volumes.empty())
        throw InputError(file + ": has volumes: the lever is modelled in its plane; give its surfaces in z = 0 alone, "
                                "Lever/Width is the third dimension");
      std::vector<std::size_t> nodes;
      std::vector<double> positions, parametric;
      gmsh::model::mesh::getNodes(nodes, positions, parametric);
      double size = 0., farthest = 0.;
      for (std::size_t i = 0; i < positions.size(); ++i)
      {
        size = std::max(size, std::abs(positions[i]));
        if (i % 3 == 2 && std::abs(positions[i]) > std::abs(farthest))
          farthest = positions[i];
      }
      if (std::abs(farthest) > 1e-9 * size)
        throw InputError(file + ": has a node at z = " + rounded_text(farthest) +
                         " mm: the lever is modelled in its plane, x along it and y away from the cylinder; z must be 0");
    }

    std::vector<std::string> arguments_of(const std::vector<std::pair<std::string, double>> &constants)
    {
      std::vector<std::string> arguments = { "sprag" };
      for (const auto &[name, value] : constants)
      {
        char number[32];
        std::snprintf(number, sizeof(number), "%.17g", value);
        arguments.insert(arguments.end(), { "-setnumber", name, number });
      }
      return arguments;
    }

    /// Runs gmsh and leaves its mesh in `output`.
    GroupIds run_gmsh(const std::string &file, const std::vector<std::pair<std::string, double>> &constants,
                      const MeshGroups &groups, const std::string &output)
    {
      if (!std::ifstream(file))
        throw InputError(file + ": the mesh file cannot be read");
      const GmshSession session(arguments_of(constants));
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
        const GroupIds ids = read_groups(file, groups);
        refuse_third_dimension(file);
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

  std::string quoted_list(const std::set<std::string> &names)
  {
    std::string text;
    for (const auto &name : names)
      text += (text.empty() ? "'" : ", '") + name + "'";
    return text.empty() ? "none" : text;
  }

  std::string mesh_script(const std::string &name)
  {
    return SPRAG_MESHES "/" + name;
  }

  void read_gmsh(const std::string &file, const std::vector<std::pair<std::string, double>> &constants, const MeshGroups &groups,
                 Triangulation<2> &triangulation)
  {
    const TemporaryFile output;
    const GroupIds ids = run_gmsh(file, constants, groups, output.path);
    std::ifstream stream(output.path);
    read(file, stream, triangulation);
    rename_ids(ids, triangulation);
  }
} // namespace sprag
