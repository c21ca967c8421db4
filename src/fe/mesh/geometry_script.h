// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "base/text.h"

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

  /// Meaning of the physical groups of a mesh: surfaces and the curves about them in a plane, volumes and surfaces in three
  /// dimensions.
  struct MeshGroups
  {
    std::map<std::string, dealii::types::material_id> parts;
    std::map<std::string, dealii::types::boundary_id> sides;
    std::string part_names; ///< the admissible ones in words

    /// Lists the missing parts and sides, a line each.
    std::function<std::vector<std::string>(const std::set<std::string> &parts, const std::set<std::string> &sides)> missing =
        [](const auto &, const auto &) { return std::vector<std::string>(); };
  };

  /// Writes names as "'a', 'b'", or "none".
  std::string quoted_list(const std::set<std::string> &names);

  /// Writes a place as "(1, 2) mm".
  template <int dim>
  std::string place_text(const dealii::Point<dim> &place)
  {
    std::string result = "(" + rounded_text(place[0]);
    for (unsigned int d = 1; d < dim; ++d)
      result += ", " + rounded_text(place[d]);
    return result + ") mm";
  }

  /// Returns the path of one of our scripts in `meshes`, "lever.geo".
  std::string mesh_script(const std::string &name);

  /// Lets scripts that are meshed from now on do all that the user may. Otherwise they can read their own folder and ours and
  /// neither write a file nor start a program.
  void trust_scripts();

  /// Meshes a gmsh .geo with constants for its DefineConstant, or reads a .msh, of 4-node quadrilaterals or 8-node hexahedra
  /// [mm]; materials and boundaries get the ids of their groups, other boundaries 0. Throws InputError naming the file and all
  /// that is wrong with it.
  template <int dim>
  void read_gmsh(const std::string &file, const MeshConstants &constants, const MeshGroups &groups,
                 dealii::Triangulation<dim> &triangulation);

  /// Returns whether a gmsh .geo or .msh has volumes. Throws InputError for one that cannot be read.
  bool has_volumes(const std::string &file);
} // namespace sprag
