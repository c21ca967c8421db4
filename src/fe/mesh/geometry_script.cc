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

    /// Physical tags by meaning. Reports everything that is missing or unknown at once.
    Answer read_groups(const std::string &file, const MeshGroups &groups)
    {
      Answer ids;
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

    Answer run_gmsh(const std::string &file, const MeshConstants &constants, const MeshGroups &groups)
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
        std::vector<std::size_t> nodes;
        std::vector<double> positions, parametric;
        gmsh::model::mesh::getNodes(nodes, positions, parametric);
        if (nodes.empty())
          gmsh::model::mesh::generate(2);
        Answer answer = read_groups(file, groups);
        refuse_third_dimension(file);
        refuse_other_elements(file);
        answer.mesh = written_mesh();
        return answer;
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

    void rename_ids(const Answer &ids, Triangulation<2> &triangulation)
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
      {
        const Point<2> corners[] = { cell->vertex(0), cell->vertex(1), cell->vertex(2), cell->vertex(3) };
        Tensor<0, 2> areas[4];
        GeometryInfo<2>::alternating_form_at_vertices(corners, areas);
        for (const double area : areas)
          if (!(area > 0.))
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

    /// Carried out in a process of its own.
    Answer gmsh_answer(const std::string &file, const MeshConstants &constants, const MeshGroups &groups)
    {
      try
      {
        auto answer = run_gmsh(file, constants, groups);
        Triangulation<2> trial;
        if (constants.empty()) // a user's own may be anything
          read(file, answer.mesh, trial);
        return answer;
      }
      catch (const InputError &error)
      {
        return { error.messages, {}, {}, {} };
      }
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

  void read_gmsh(const std::string &file, const MeshConstants &constants, const MeshGroups &groups,
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
      const auto packed = Utilities::pack(gmsh_answer(file, constants, groups), false);
      return std::string(packed.begin(), packed.end());
    };
    const auto found = in_child_process(work, is_mesh ? mesh_patience + 1e-6 * static_cast<double>(bytes) : 0.);
    if (!found.failure.empty())
      throw InputError(file + ": gmsh " + found.failure + " on it: the file is damaged, or meshing it needs too much memory");
    const auto answer = Utilities::unpack<Answer>(std::vector<char>(found.text.begin(), found.text.end()), false);
    if (!answer.mistakes.empty())
      throw InputError(answer.mistakes);
    read(file, answer.mesh, triangulation);
    rename_ids(answer, triangulation);
  }
} // namespace sprag
