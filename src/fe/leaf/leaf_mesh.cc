// SPDX-License-Identifier: GPL-3.0-only
#include "fe/leaf/leaf_mesh.h"

#include "base/errors.h"
#include "base/text.h"
#include "fe/body/body_properties.h"
#include "fe/mesh/geometry_script.h"

#include <deal.II/grid/manifold_lib.h>

#include <cmath>

namespace sprag
{
  using namespace dealii;

  namespace
  {
    /// Over the length. Half of that is 0.4 % off by round-off, a twentieth buckles at rest.
    constexpr double thinnest = 2e-4;

    void refuse_impossible_shapes(const LeafSpring &leaf)
    {
      std::vector<std::string> mistakes;
      const auto refuse = [&](const std::string &name, const double value)
      {
        mistakes.push_back("Leaf spring/" + name + " = " + rounded_text(value) +
                           ": must be less than half of Leaf spring/Length (" + rounded_text(0.5 * leaf.length) + " mm)");
      };
      if (!(std::abs(leaf.sagitta) < 0.5 * leaf.length))
        refuse("Sagitta", leaf.sagitta);
      if (!(leaf.thickness < 0.5 * leaf.length))
        refuse("Thickness", leaf.thickness);
      if (!(leaf.thickness >= thinnest * leaf.length))
        mistakes.push_back("Leaf spring/Thickness = " + rounded_text(leaf.thickness) + ": must be at least " +
                           rounded_text(thinnest) + " of Leaf spring/Length (" + rounded_text(thinnest * leaf.length) +
                           " mm), or its stiffness is lost in round-off");
      if (!mistakes.empty())
        throw InputError(mistakes);
    }

    Point<2> centre_of_arc(const LeafSpring &leaf)
    {
      const double radius = (0.25 * leaf.length * leaf.length + leaf.sagitta * leaf.sagitta) / (2. * leaf.sagitta);
      return { -leaf.clamp_distance - 0.5 * leaf.length, leaf.sagitta - radius };
    }
  } // namespace

  bool is_bent(const LeafSpring &leaf)
  {
    return std::abs(leaf.sagitta) >= 1e-6 * leaf.length;
  }

  LeafElements leaf_elements(const LeafSpring &leaf)
  {
    return { static_cast<unsigned int>(std::ceil(7. * std::sqrt(leaf.length / leaf.thickness))), 2 };
  }

  void make_leaf_mesh(const LeafSpring &leaf, const LeafElements &elements, Triangulation<2> &triangulation)
  {
    refuse_impossible_shapes(leaf);
    const MeshGroups groups{ { { "leaf", material_id::leaf } },
                             { { "hub", boundary_id::clamp }, { "joint", boundary_id::joint } },
                             "'leaf'" };
    read_gmsh(mesh_script("leaf.geo"),
              { { "leaf_length", leaf.length },
                { "leaf_thickness", leaf.thickness },
                { "sagitta", leaf.sagitta },
                { "clamp_distance", leaf.clamp_distance },
                { "elements_along", elements.along },
                { "elements_across", elements.across } },
              groups, triangulation);
    if (!is_bent(leaf))
      return;
    triangulation.set_all_manifold_ids(0);
    triangulation.set_manifold(0, PolarManifold<2>(centre_of_arc(leaf)));
  }
} // namespace sprag
