#include "fe/mesh/geometry_script.h"

#include "base/child_process.h"
#include "base/errors.h"
#include "base/text.h"

#include <deal.II/base/utilities.h>
#include <deal.II/grid/grid_in.h>

#include <boost/algorithm/string/join.hpp>
#include <boost/serialization/map.hpp>
#include <boost/serialization/string.hpp>
#include <boost/serialization/vector.hpp>

#include <gmsh.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <unistd.h>

namespace sprag
{
  using namespace dealii;

  namespace
  {
    /// A damaged mesh may keep gmsh busy for ever [s], or ask for all the memory there is [bytes].
    constexpr double mesh_patience  = 20.;
    constexpr std::size_t mesh_room = std::size_t(1) << 30;

    /// What the process that runs gmsh hands back.
    struct Answer
    {
      std::vector<std::string> mistakes;            ///< or, without any, what follows
      std::map<int, types::material_id> materials;  ///< by physical tag
      std::map<int, types::boundary_id> boundaries; ///< by physical tag
      std::string mesh;                             ///< in gmsh's format 2.2

      template <class Archive>
      void serialize(Archive &archive, const unsigned int /*version*/)
      {
        archive &mistakes &materials &boundaries &mesh;
      }
    };

    /// Elements of a dimension by their nodes, to tell those that two groups with a meaning claim.
    struct Claims
    {
      std::map<std::vector<std::size_t>, std::string> group; ///< by sorted nodes
      std::set<std::pair<std::string, std::string>> shared;

      void add(const int dim, const int tag, const std::string &name)
      {
        std::vector<int> entities;
        gmsh::model::getEntitiesForPhysicalGroup(dim, tag, entities);
        for (const int entity : entities)
        {
          std::vector<int> types;
          std::vector<std::vector<std::size_t>> elements, nodes;
          gmsh::model::mesh::getElements(types, elements, nodes, dim, entity);
          for (std::size_t i = 0; i < types.size(); ++i)
          {
            const std::size_t n = nodes[i].size() / std::max<std::size_t>(1, elements[i].size());
            for (auto corner = nodes[i].begin(); corner != nodes[i].end(); corner += static_cast<std::ptrdiff_t>(n))
            {
              std::vector<std::size_t> key(corner, corner + static_cast<std::ptrdiff_t>(n));
              std::sort(key.begin(), key.end());
              const auto found = group.insert({ key, name }).first;
              if (found->second != name)
                shared.insert(std::minmax(found->second, name));
            }
          }
        }
      }
    };

    /// Physical tags by meaning. Reports everything that is missing or unknown at once. Of a mesh in three dimensions it takes
    /// groups without a meaning away: those of the surface that was extruded lie inside.
    Answer read_groups(const std::string &file, const MeshGroups &groups, const int dim)
    {
      const std::string part = dim == 2 ? "surface" : "volume";
      Answer ids;
      std::set<std::string> parts, sides;
      std::vector<std::string> mistakes;
      Claims of_parts, of_sides;
      gmsh::vectorpair tags;
      gmsh::model::getPhysicalGroups(tags);
      for (const auto &[group_dim, tag] : tags)
      {
        std::string name;
        gmsh::model::getPhysicalName(group_dim, tag, name);
        if (group_dim == dim && groups.parts.count(name) != 0)
        {
          ids.materials[tag] = groups.parts.at(name);
          of_parts.add(dim, tag, name);
        }
        else if (group_dim == dim - 1 && groups.sides.count(name) != 0)
        {
          ids.boundaries[tag] = groups.sides.at(name);
          of_sides.add(dim - 1, tag, name);
        }
        else if (group_dim == dim)
          mistakes.push_back(file + ": unknown physical " + part + " '" + name + "': " + part + "s are " + groups.part_names);
        else if (dim == 3)
          gmsh::model::removePhysicalGroups({ { group_dim, tag } });
        if (group_dim == dim)
          parts.insert(name);
        else if (group_dim == dim - 1)
          sides.insert(name);
      }
      for (const auto &shared : { of_parts.shared, of_sides.shared })
        for (const auto &[one, other] : shared)
          mistakes.push_back(file + ": the physical groups '" + one + "' and '" + other +
                             "' have elements in common; each belongs to one of them");
      for (const auto &line : groups.missing(parts, sides))
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

    void refuse_other_solids(const std::string &file)
    {
      std::vector<int> types;
      std::vector<std::vector<std::size_t>> tags, nodes;
      gmsh::model::mesh::getElements(types, tags, nodes, 3);
      const int hexahedron = gmsh::model::mesh::getElementType("hexahedron", 1);
      std::vector<std::string> others;
      for (std::size_t i = 0; i < types.size(); ++i)
        if (types[i] != hexahedron)
        {
          std::string name;
          int dimension = 0, order = 0, n_nodes = 0, n_primary = 0;
          std::vector<double> places;
          gmsh::model::mesh::getElementProperties(types[i], name, dimension, order, n_nodes, places, n_primary);
          others.push_back(std::to_string(tags[i].size()) + " elements '" + name + "'");
        }
      if (!others.empty())
        throw InputError(file + ": the mesh has " + boost::algorithm::join(others, ", ") +
                         ", but must be made of hexahedra with 8 nodes; in a .geo extrude surfaces of quadrilaterals in layers: "
                         "'Recombine Surface {s}; Extrude {0, 0, 40} { Surface{s}; Layers{10}; Recombine; }', or use "
                         "'Transfinite Volume' and 'Recombine Surface'");
      if (types.empty())
        throw InputError(file + ": the mesh has no elements in a physical volume");
    }

    bool open_model_has_volumes()
    {
      std::vector<int> types;
      std::vector<std::vector<std::size_t>> tags, corners;
      gmsh::model::mesh::getElements(types, tags, corners, 3);
      gmsh::vectorpair volumes;
      gmsh::model::getEntities(volumes, 3);
      return !types.empty() || !volumes.empty();
    }

    void refuse_volumes(const std::string &file)
    {
      if (open_model_has_volumes())
        throw InputError(file + ": has volumes: the lever is modelled in its plane; give its surfaces in z = 0 alone, "
                                "Lever/Width is the third dimension, or set Analysis/Dimension = 3");
    }

    /// A plane lever's mesh lies in z = 0: another would be read as its shadow.
    void refuse_third_dimension(const std::string &file)
    {
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
        throw InputError(file + ": has a node at z = " + mm(farthest) +
                         ": the lever is modelled in its plane, x along it and y away from the cylinder; z must be 0");
    }

    /// What gmsh writes; the end of the process waits until its file is gone.
    std::string written_mesh()
    {
      sigset_t all, before;
      sigfillset(&all);
      ::sigprocmask(SIG_BLOCK, &all, &before);
      const auto folder      = std::filesystem::temp_directory_path();
      const std::string path = (folder / ("sprag-" + std::to_string(::getpid()) + ".msh")).string();
      gmsh::write(path);
      std::ifstream stream(path);
      const std::string mesh{ std::istreambuf_iterator<char>(stream), {} };
      std::remove(path.c_str());
      ::sigprocmask(SIG_SETMASK, &before, nullptr);
      return mesh;
    }

    /// Opens a file and does something with the model.
    Answer run_gmsh(const std::string &file, const MeshConstants &constants, const std::function<Answer()> &work)
    {
      std::vector<std::string> arguments = { "sprag" };
      for (const auto &[name, value] : constants)
        arguments.insert(arguments.end(), { "-setnumber", name, formatted("%.17g", value) });
      std::vector<char *> argv;
      for (auto &argument : arguments)
        argv.push_back(argument.data());
      gmsh::initialize(static_cast<int>(argv.size()), argv.data(), false); // and never finalised: the process ends first
      gmsh::option::setNumber("General.Terminal", 0);
      gmsh::option::setNumber("Mesh.MshFileVersion", 2.2);
      try
      {
        gmsh::open(file);
        return work();
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

    Answer meshed(const std::string &file, const MeshGroups &groups, const int dim)
    {
      std::vector<std::size_t> nodes;
      std::vector<double> positions, parametric;
      gmsh::model::mesh::getNodes(nodes, positions, parametric);
      if (nodes.empty())
        gmsh::model::mesh::generate(dim);
      if (dim == 2)
        refuse_volumes(file);
      Answer answer = read_groups(file, groups, dim);
      if (dim == 2)
      {
        refuse_third_dimension(file);
        refuse_other_elements(file);
      }
      else
        refuse_other_solids(file);
      answer.mesh = written_mesh();
      return answer;
    }

    template <int dim>
    void rename_ids(const Answer &ids, Triangulation<dim> &triangulation)
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

    /// Of cells whose corners are damaged deal.II makes what it can.
    template <int dim>
    void refuse_inverted_cells(const std::string &file, const Triangulation<dim> &triangulation)
    {
      constexpr unsigned int n = GeometryInfo<dim>::vertices_per_cell;
      for (const auto &cell : triangulation.active_cell_iterators())
      {
        Point<dim> corners[n];
        for (unsigned int v = 0; v < n; ++v)
          corners[v] = cell->vertex(v);
        Tensor<0, dim> contents[n];
        GeometryInfo<dim>::alternating_form_at_vertices(corners, contents);
        for (const double content : contents)
          if (!(content > 0.))
          {
            std::string place = rounded_text(cell->center()[0]);
            for (unsigned int d = 1; d < dim; ++d)
              place += ", " + rounded_text(cell->center()[d]);
            throw InputError(file + ": the cell at (" + place + ") mm is degenerate or turned inside out");
          }
      }
    }

    template <int dim>
    void read(const std::string &file, const std::string &mesh, Triangulation<dim> &triangulation)
    {
      std::istringstream stream(mesh);
      try
      {
        GridIn<dim> reader(triangulation);
        reader.read_msh(stream);
      }
      catch (const dealii::ExceptionBase &)
      {
        const std::string part = dim == 2 ? "surface" : "volume", side = dim == 2 ? "curve" : "surface";
        throw InputError(file + ": the mesh cannot be used: a " + part + " is in two physical groups, a physical " + side +
                         " lies inside the body, or cells do not match along a common side");
      }
      refuse_inverted_cells(file, triangulation);
    }

    /// Of a process of its own that opens the file and does something with the model.
    Answer answer_of_gmsh(const std::string &file, const MeshConstants &constants, const std::function<Answer()> &work)
    {
      std::error_code ignored;
      if (!std::filesystem::is_regular_file(file, ignored) || !std::ifstream(file))
        throw InputError(file + ": the mesh file cannot be read");
      const bool is_mesh    = std::filesystem::path(file).extension() == ".msh"; // and no script, which may take its time
      const auto bytes      = std::filesystem::file_size(file);
      const auto in_process = [&]
      {
        if (is_mesh)
          limit_growth(mesh_room + 200 * bytes);
        Answer answer;
        try
        {
          answer = run_gmsh(file, constants, work);
        }
        catch (const InputError &error)
        {
          answer.mistakes = error.messages;
        }
        const auto packed = Utilities::pack(answer, false);
        return std::string(packed.begin(), packed.end());
      };
      const auto found = in_child_process(in_process, is_mesh ? mesh_patience + 1e-6 * static_cast<double>(bytes) : 0.);
      if (!found.failure.empty())
        throw InputError(file + ": gmsh " + found.failure + " on it: the file is damaged, or meshing it needs too much memory");
      auto answer = Utilities::unpack<Answer>(std::vector<char>(found.text.begin(), found.text.end()), false);
      if (!answer.mistakes.empty())
        throw InputError(answer.mistakes);
      return answer;
    }
  } // namespace

  std::string quoted_list(const std::set<std::string> &names)
  {
    return names.empty() ? "none" : "'" + boost::algorithm::join(names, "', '") + "'";
  }

  std::string mesh_script(const std::string &name)
  {
    std::error_code error;
    const auto program   = std::filesystem::read_symlink("/proc/self/exe", error);
    const auto installed = program.parent_path() / SPRAG_INSTALLED_MESHES / name;
    return std::filesystem::is_regular_file(installed, error) ? installed.lexically_normal().string() : SPRAG_MESHES "/" + name;
  }

  template <int dim>
  void read_gmsh(const std::string &file, const MeshConstants &constants, const MeshGroups &groups,
                 Triangulation<dim> &triangulation)
  {
    const auto mesh_it = [&]
    {
      auto answer = meshed(file, groups, dim);
      Triangulation<dim> trial;
      if (constants.empty()) // a user's own may be anything
        read(file, answer.mesh, trial);
      return answer;
    };
    const auto answer = answer_of_gmsh(file, constants, mesh_it);
    read(file, answer.mesh, triangulation);
    rename_ids(answer, triangulation);
  }

  template void read_gmsh(const std::string &, const MeshConstants &, const MeshGroups &, Triangulation<2> &);
  template void read_gmsh(const std::string &, const MeshConstants &, const MeshGroups &, Triangulation<3> &);

  bool has_volumes(const std::string &file)
  {
    return !answer_of_gmsh(file, {}, [] { return Answer{ {}, {}, {}, open_model_has_volumes() ? "volumes" : "" }; }).mesh.empty();
  }
} // namespace sprag
