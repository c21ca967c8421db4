#include "fe/mesh/geometry_script.h"

#include "base/child_process.h"
#include "base/errors.h"
#include "base/text.h"

#include <deal.II/grid/grid_in.h>

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

    std::vector<std::string> lines_of(const std::string &text)
    {
      std::vector<std::string> lines;
      std::istringstream stream(text);
      for (std::string line; std::getline(stream, line);)
        lines.push_back(line);
      return lines;
    }

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
      GmshSession &operator=(GmshSession &&) = delete;
      ~GmshSession()
      {
        gmsh::finalize();
      }
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
        throw InputError(file + ": has a node at z = " + mm(farthest) +
                         ": the lever is modelled in its plane, x along it and y away from the cylinder; z must be 0");
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

    /// Ids and the mesh itself, in gmsh's format 2.2.
    std::pair<GroupIds, std::string>
    run_gmsh(const std::string &file, const std::vector<std::pair<std::string, double>> &constants, const MeshGroups &groups)
    {
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
        return { ids, written_mesh() };
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

    /// Of cells whose corners are damaged deal.II makes what it can.
    void refuse_inverted_cells(const std::string &file, const Triangulation<2> &triangulation)
    {
      for (const auto &cell : triangulation.active_cell_iterators())
        for (const unsigned int v : { 0, 1, 2, 3 })
        {
          constexpr unsigned int next[] = { 1, 3, 0, 2 }, last[] = { 2, 0, 3, 1 }; // anticlockwise
          const auto a = cell->vertex(next[v]) - cell->vertex(v), b = cell->vertex(last[v]) - cell->vertex(v);
          if (!(a[0] * b[1] - a[1] * b[0] > 0.))
            throw InputError(file + ": the cell at (" + rounded_text(cell->center()[0]) + ", " + rounded_text(cell->center()[1]) +
                             ") mm is degenerate or turned inside out");
        }
    }

    void read(const std::string &file, const std::string &mesh, Triangulation<2> &triangulation)
    {
      std::istringstream stream(mesh);
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
      refuse_inverted_cells(file, triangulation);
    }

    // What the process that runs gmsh hands back: a kind, then mistakes, a line each, or ids and mesh.
    constexpr char refused = 'r', meshed = 'm';

    std::string mesh_text(const GroupIds &ids, const std::string &mesh)
    {
      std::ostringstream text;
      text << meshed << ids.materials.size() << ' ' << ids.boundaries.size();
      for (const auto &[tag, id] : ids.materials)
        text << ' ' << tag << ' ' << id;
      for (const auto &[tag, id] : ids.boundaries)
        text << ' ' << tag << ' ' << id;
      return text.str() + '\n' + mesh;
    }

    GroupIds ids_of(std::istream &text)
    {
      GroupIds ids;
      std::size_t materials = 0, boundaries = 0;
      int tag         = 0;
      unsigned int id = 0;
      text >> materials >> boundaries;
      for (; materials > 0 && text >> tag >> id; --materials)
        ids.materials[tag] = id;
      for (; boundaries > 0 && text >> tag >> id; --boundaries)
        ids.boundaries[tag] = id;
      return ids;
    }

    /// Carried out in a process of its own.
    std::string gmsh_answer(const std::string &file, const std::vector<std::pair<std::string, double>> &constants,
                            const MeshGroups &groups)
    {
      try
      {
        const auto [ids, mesh] = run_gmsh(file, constants, groups);
        Triangulation<2> trial;
        if (constants.empty()) // a user's own may be anything
          read(file, mesh, trial);
        return mesh_text(ids, mesh);
      }
      catch (const InputError &error)
      {
        return refused + std::string(error.what());
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
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(file, ignored) || !std::ifstream(file))
      throw InputError(file + ": the mesh file cannot be read");
    const bool is_mesh = std::filesystem::path(file).extension() == ".msh"; // and no script, which may take its time
    const auto bytes   = std::filesystem::file_size(file);
    const auto work    = [&]
    {
      if (is_mesh)
        limit_growth(mesh_room + 200 * bytes);
      return gmsh_answer(file, constants, groups);
    };
    const auto answer = in_child_process(work, is_mesh ? mesh_patience + 1e-6 * static_cast<double>(bytes) : 0.);
    if (!answer.failure.empty())
      throw InputError(file + ": gmsh " + answer.failure + " on it: the file is damaged, or meshing it needs too much memory");
    if (answer.text.front() == refused)
      throw InputError(lines_of(answer.text.substr(1)));
    std::istringstream text(answer.text.substr(1));
    const GroupIds ids = ids_of(text);
    read(file, answer.text.substr(answer.text.find('\n') + 1), triangulation);
    rename_ids(ids, triangulation);
  }
} // namespace sprag
