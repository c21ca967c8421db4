#pragma once

#include <deal.II/grid/tria.h>

#include <functional>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace sprag
{
  /// Values by the names that a script's DefineConstant gives them.
  using MeshConstants = std::vector<std::pair<std::string, double>>;

  /// What the physical groups of a mesh mean.
  struct MeshGroups
  {
    std::map<std::string, dealii::types::material_id> surfaces;
    std::map<std::string, dealii::types::boundary_id> curves;
    std::string surface_names; ///< the admissible ones in words

    /// Tells what is missing among the surfaces and curves found, a line each.
    std::function<std::vector<std::string>(const std::set<std::string> &surfaces, const std::set<std::string> &curves)> missing =
        [](const auto &, const auto &) { return std::vector<std::string>(); };
  };

  /// Writes names as "'a', 'b'", or "none".
  std::string quoted_list(const std::set<std::string> &names);

  /// Returns the path of one of our scripts in `meshes`, "lever.geo".
  std::string mesh_script(const std::string &name);

  /// Meshes a gmsh .geo with constants for its DefineConstant, or reads a .msh, of 4-node quadrilaterals [mm]; materials and
  /// boundaries get the ids of their groups, other boundaries 0. Throws InputError naming the file and all that is wrong with it.
  void read_gmsh(const std::string &file, const MeshConstants &constants, const MeshGroups &groups,
                 dealii::Triangulation<2> &triangulation);
} // namespace sprag
