// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "scene/apparatus.h"

#include <deal.II/grid/tria.h>

namespace sprag
{
  struct LeafElements
  {
    unsigned int along;
    unsigned int across;
  };

  /// Returns as many elements of degree 2 as put the stiffness of a thin leaf within 2.5e-4 of that of a fine mesh.
  LeafElements leaf_elements(const LeafSpring &leaf);

  /// Makes the mesh of the built-in `meshes/leaf.geo`, in axes of the lever at rest: material_id::leaf from boundary_id::clamp to
  /// boundary_id::joint. A bent leaf has a manifold, on which its cells are curved. Throws InputError where leaf.sagitta or
  /// leaf.thickness is half of the length or more.
  void make_leaf_mesh(const LeafSpring &leaf, const LeafElements &elements, dealii::Triangulation<2> &triangulation);

  /// Returns whether the leaf is bent by more than what the mesh takes for straight.
  bool is_bent(const LeafSpring &leaf);
} // namespace sprag
