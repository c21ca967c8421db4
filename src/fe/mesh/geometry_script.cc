// SPDX-License-Identifier: GPL-3.0-only
#include "fe/mesh/geometry_script.h"

#include "base/archive.h"
#include "base/errors.h"
#include "base/shipped_file.h"
#include "base/system/child_process.h"
#include "base/system/confinement.h"
#include "base/system/file_content.h"
#include "base/system/memory.h"
#include "base/text.h"

#include <deal.II/base/utilities.h>
#include <deal.II/grid/grid_in.h>

#include <boost/algorithm/string/join.hpp>
#include <boost/algorithm/string/replace.hpp>

#include <gmsh.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fcntl.h>
#include <filesystem>
#include <optional>
#include <sstream>
#include <string_view>
#include <unistd.h>

namespace sprag
{
  using namespace dealii;

  namespace
  {
    /// Limits of time [s] and memory [bytes] for gmsh, which may never end on a damaged mesh.
    constexpr double mesh_timeout     = 20.;
    constexpr std::size_t mesh_memory = std::size_t(1) << 30;

    /// Share of the free memory and time [s] that a user's script may take, so that other programs keep theirs and loops end.
    constexpr double script_share   = 0.8;
    constexpr double script_timeout = 300.;

    /// Names a shorter time for tests [s].
    constexpr char patience_variable[] = "SPRAG_SCRIPT_SECONDS";

    /// Result of the process that runs gmsh.
    struct Answer
    {
      std::vector<std::string> mistakes;            ///< or, without any, what follows
      std::map<int, types::material_id> materials;  ///< by physical tag
      std::map<int, types::boundary_id> boundaries; ///< by physical tag
      std::string mesh;                             ///< in gmsh's format 2.2
    };

    SPRAG_SERIALISE(Answer, mistakes, materials, boundaries, mesh)

    /// Elements of a dimension by their types, those of one entity or all.
    struct GmshElements
    {
      std::vector<int> types;
      std::vector<std::vector<std::size_t>> tags, nodes;

      explicit GmshElements(const int dim, const int entity = -1)
      {
        gmsh::model::mesh::getElements(types, tags, nodes, dim, entity);
      }
    };

    struct GmshNodes
    {
      std::vector<std::size_t> tags;
      std::vector<double> positions; ///< three a node

      GmshNodes()
      {
        std::vector<double> parametric;
        gmsh::model::mesh::getNodes(tags, positions, parametric);
      }
    };

    gmsh::vectorpair find_entities(const int dim)
    {
      gmsh::vectorpair result;
      gmsh::model::getEntities(result, dim);
      return result;
    }

    /// Elements of a dimension by their nodes, to find those in two physical groups.
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
          const auto [types, elements, nodes] = GmshElements(dim, entity);
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

    /// Returns how many elements of a dimension are in no physical group, of which gmsh writes none.
    std::size_t number_without_group(const int dim)
    {
      std::size_t result = 0;
      for (const auto &[entity_dim, entity] : find_entities(dim))
      {
        std::vector<int> groups;
        gmsh::model::getPhysicalGroupsForEntity(entity_dim, entity, groups);
        for (const auto &type_elements : GmshElements(entity_dim, entity).tags)
          result += groups.empty() ? type_elements.size() : 0;
      }
      return result;
    }

    /// Physical tags by meaning. Reports everything that is missing or unknown at once. It takes groups without a meaning away:
    /// they may share elements with others or lie inside.
    Answer read_groups(const std::string &file, const MeshGroups &groups, const int dim)
    {
      const std::string part = dim == 2 ? "surface" : "volume";
      Answer ids;
      std::set<std::string> parts, sides;
      std::vector<std::string> mistakes;
      Claims part_claims, side_claims;
      gmsh::vectorpair tags;
      gmsh::model::getPhysicalGroups(tags);
      for (const auto &[group_dim, tag] : tags)
      {
        std::string name;
        gmsh::model::getPhysicalName(group_dim, tag, name);
        if (group_dim == dim && groups.parts.count(name) != 0)
        {
          ids.materials[tag] = groups.parts.at(name);
          part_claims.add(dim, tag, name);
        }
        else if (group_dim == dim - 1 && groups.sides.count(name) != 0)
        {
          ids.boundaries[tag] = groups.sides.at(name);
          side_claims.add(dim - 1, tag, name);
        }
        else if (group_dim == dim)
          mistakes.push_back(file + ": unknown physical " + part + " '" + name + "': " + part + "s are " + groups.part_names);
        else
          gmsh::model::removePhysicalGroups({ { group_dim, tag } });
        if (group_dim == dim)
          parts.insert(name);
        else if (group_dim == dim - 1)
          sides.insert(name);
      }
      for (const auto &shared : { part_claims.shared, side_claims.shared })
        for (const auto &[one, other] : shared)
          mistakes.push_back(file + ": the physical groups '" + one + "' and '" + other +
                             "' have elements in common; each belongs to one of them");
      for (const auto &line : groups.missing(parts, sides))
        mistakes.push_back(file + ": " + line);
      if (const auto lost = number_without_group(dim); lost > 0 && mistakes.empty())
        mistakes.push_back(file + ": " + std::to_string(lost) + " elements are in no physical " + part +
                           " and would be left out: give them a group, or delete what is no part of the lever");
      if (!mistakes.empty())
        throw InputError(mistakes);
      return ids;
    }

    void refuse_other_elements(const std::string &file)
    {
      const auto types        = GmshElements(2).types;
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
      const auto [types, tags, nodes] = GmshElements(3);
      const int hexahedron            = gmsh::model::mesh::getElementType("hexahedron", 1);
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
      return !GmshElements(3).types.empty() || !find_entities(3).empty();
    }

    void refuse_volumes(const std::string &file)
    {
      if (open_model_has_volumes())
        throw InputError(file + ": has volumes: the lever is modelled in its plane; give its surfaces in z = 0 alone, "
                                "Lever/Width is the third dimension, or set Analysis/Dimension = 3");
    }

    /// Requires the mesh of a plane lever in z = 0: another would be projected.
    void refuse_third_dimension(const std::string &file)
    {
      const auto positions = GmshNodes().positions;
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

    /// The elements of physical groups and their nodes in gmsh's format 2.2, in the order in which gmsh::write() has them: this
    /// process may open no file to write.
    std::string mesh_text(const int dim)
    {
      std::set<std::size_t> used;
      std::string elements, nodes;
      std::size_t n_elements = 0;
      for (int entities_dim = 1; entities_dim <= dim; ++entities_dim)
      {
        for (const auto &[entity_dim, entity] : find_entities(entities_dim))
        {
          std::vector<int> groups;
          gmsh::model::getPhysicalGroupsForEntity(entity_dim, entity, groups);
          if (groups.empty())
            continue;
          const auto [types, tags, corners] = GmshElements(entity_dim, entity);
          for (std::size_t i = 0; i < types.size(); ++i)
            for (std::size_t j = 0; j < tags[i].size(); ++j)
            {
              const std::size_t n = corners[i].size() / tags[i].size();
              std::string line;
              for (std::size_t k = j * n; k < (j + 1) * n; ++k)
              {
                used.insert(corners[i][k]);
                line += ' ' + std::to_string(corners[i][k]);
              }
              for (const int group : groups)
                elements += formatted("%zu %d 2 %d %d", ++n_elements, types[i], std::abs(group), entity) + line + '\n';
            }
        }
      }
      const auto [tags, positions] = GmshNodes();
      for (std::size_t i = 0; i < tags.size(); ++i)
        if (used.count(tags[i]) > 0)
        {
          nodes += std::to_string(tags[i]);
          for (std::size_t d = 0; d < 3; ++d)
            nodes += formatted(" %.16g", positions[3 * i + d]);
          nodes += '\n';
        }
      return "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n" + std::to_string(used.size()) + '\n' + nodes +
             "$EndNodes\n$Elements\n" + std::to_string(n_elements) + '\n' + elements + "$EndElements\n";
    }

    bool scripts_are_trusted = false;

    bool is_script(const std::string &file)
    {
      return std::filesystem::path(file).extension() == ".geo";
    }

    /// The folder of a file, which a script may include others from.
    std::string parent_folder(const std::string &file)
    {
      return std::filesystem::absolute(file).parent_path().lexically_normal().string();
    }

    bool is_own(const std::string &file)
    {
      return parent_folder(file) == parent_folder(mesh_script("lever.geo"));
    }

    /// Takes all rights from the process but to read the file.
    void take_rights(const std::string &file)
    {
      if (is_script(file) && scripts_are_trusted)
        return;
      std::vector<std::string> readable = { file };
      if (is_script(file))
        readable.insert(readable.end(), { parent_folder(file), parent_folder(mesh_script("lever.geo")) });
      if (!confine(readable) && is_script(file) && !is_own(file))
        throw InputError(file + ": is a script, which could start programs or read other files, as this system lacks Landlock or "
                                "seccomp to keep it from that: give a .msh, or --trust-scripts if you know what it does");
    }

    std::string hint(const std::string &file, const std::string &error)
    {
      const bool is_refused = error.find("pen file") != std::string::npos || error.find("system call") != std::string::npos;
      const bool by_rights  = is_refused && is_script(file) && !scripts_are_trusted;
      return by_rights ? "; a script may read its own folder, and write and start nothing, unless you give --trust-scripts" : "";
    }

    /// A mesh is opened by its content, independent of its name and the files beside it.
    class OpenMesh
    {
    public:
      explicit OpenMesh(const std::string &path)
          : file(::open(path.c_str(), O_RDONLY | O_CLOEXEC))
      {
        constexpr std::string_view beginning = "$MeshFormat";
        char found[beginning.size()];
        if (::pread(file, found, sizeof found, 0) != sizeof found || std::string_view(found, sizeof found) != beginning)
        {
          ::close(file);
          throw InputError(path + ": is no mesh of gmsh's: must begin with " + std::string(beginning));
        }
      }
      OpenMesh &operator=(OpenMesh &&) = delete;
      ~OpenMesh()
      {
        ::close(file);
      }

      std::string name() const
      {
        return "/proc/self/fd/" + std::to_string(file);
      }

    private:
      const int file;
    };

    /// Opens a file and does something with the model.
    Answer run_gmsh(const std::string &file, const MeshConstants &constants, const std::function<Answer()> &work)
    {
      std::optional<OpenMesh> mesh;
      if (!is_script(file))
        mesh.emplace(file);
      take_rights(file);
      std::vector<std::string> arguments = { "sprag" };
      for (const auto &[name, value] : constants)
        arguments.insert(arguments.end(), { "-setnumber", name, formatted("%.17g", value) });
      std::vector<char *> argv;
      for (auto &argument : arguments)
        argv.push_back(argument.data());
      gmsh::initialize(static_cast<int>(argv.size()), argv.data(), false); // and never finalised: the process ends first
      gmsh::option::setNumber("General.Terminal", 0);
      try
      {
        gmsh::open(mesh ? mesh->name() : file);
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
        if (mesh)
          boost::algorithm::replace_all(error, mesh->name(), file);
        throw InputError(file + ": gmsh cannot mesh it: " + error + hint(file, error));
      }
    }

    Answer meshed(const std::string &file, const MeshGroups &groups, const int dim)
    {
      if (GmshNodes().tags.empty())
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
      answer.mesh = mesh_text(dim);
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

    /// Refuses cells with inverted corners, of which deal.II would make a wrong mesh without a message.
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
            throw InputError(file + ": the cell at " + place_text<dim>(cell->center()) + " is degenerate or turned inside out");
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

    double script_patience()
    {
      const char *const environment_value = std::getenv(patience_variable);
      return environment_value == nullptr ? script_timeout : std::atof(environment_value);
    }

    /// Runs a process of its own that opens the file and calls `work` with the model, and returns its answer.
    Answer call_gmsh(const std::string &file, const MeshConstants &constants, const std::function<Answer()> &work)
    {
      if (const auto reason = reason_unreadable(file, largest_mesh); !reason.empty())
        throw InputError(file + ": " + reason);
      const bool is_mesh    = !is_script(file);
      const bool is_trusted = !is_mesh && (is_own(file) || scripts_are_trusted);
      const auto bytes      = std::filesystem::file_size(file);
      const auto in_process = [&]
      {
        const double available = available_memory().bytes;
        if (is_mesh)
          limit_growth(mesh_memory + 200 * bytes);
        else if (!is_own(file) && std::isfinite(available))
          limit_growth(static_cast<std::size_t>(script_share * available));
        Answer answer;
        try
        {
          answer = run_gmsh(file, constants, work);
        }
        catch (const InputError &error)
        {
          answer.mistakes = error.messages;
        }
        Archive packed;
        packed(answer);
        return packed.bytes();
      };
      const double patience = is_mesh ? mesh_timeout + 1e-6 * static_cast<double>(bytes) : is_trusted ? 0. : script_patience();
      const auto found      = in_child_process(in_process, patience);
      if (!found.failure.empty() || found.text.empty())
        throw InputError(file + ": gmsh " + (found.failure.empty() ? "ends" : found.failure) + " on it: the file is damaged, " +
                         (is_mesh ? "or meshing it" : "loops for ever or") + " needs too much memory" +
                         (is_mesh || is_trusted
                              ? ""
                              : "; it may take " + rounded_text(patience) + " s, and with --trust-scripts as long as it likes"));
      Answer answer;
      Archive(found.text)(answer);
      if (!answer.mistakes.empty())
        throw InputError(answer.mistakes);
      return answer;
    }
  } // namespace

  void trust_scripts()
  {
    scripts_are_trusted = true;
  }

  std::string quoted_list(const std::set<std::string> &names)
  {
    return names.empty() ? "none" : "'" + boost::algorithm::join(names, "', '") + "'";
  }

  std::string mesh_script(const std::string &name)
  {
    return shipped_file("meshes/" + name);
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
    const auto answer = call_gmsh(file, constants, mesh_it);
    read(file, answer.mesh, triangulation);
    rename_ids(answer, triangulation);
  }

  template void read_gmsh(const std::string &, const MeshConstants &, const MeshGroups &, Triangulation<2> &);
  template void read_gmsh(const std::string &, const MeshConstants &, const MeshGroups &, Triangulation<3> &);

  bool has_volumes(const std::string &file)
  {
    return !call_gmsh(file, {}, [] { return Answer{ {}, {}, {}, open_model_has_volumes() ? "volumes" : "" }; }).mesh.empty();
  }
} // namespace sprag
