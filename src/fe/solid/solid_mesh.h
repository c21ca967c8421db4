// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "fe/body/dimension.h"

#include <deal.II/distributed/shared_tria.h>

namespace sprag
{
  struct Scene;

  /// A mesh of three dimensions, which every rank knows whole and shares the work on.
  using SolidMesh = dealii::parallel::shared::Triangulation<3>;

  /// Extrudes the plane mesh of the scene's lever over its width, or over a half of it where it is symmetric; zeta counts from
  /// the middle. A web is as wide as the scene has it, in the middle: planes across hold its sides, and its cells beyond them are
  /// left out. Materials and boundaries keep their ids, the ends are free, that in the middle boundary_id::symmetry. A plane mesh
  /// without cells stands for a Mesh/File of three dimensions, which is read as it is. Returns whether the mesh is a half. To be
  /// called by the first rank, while the others receive_solid_mesh(). All throw InputError for a file that cannot serve, see
  /// read_solid_file().
  bool make_solid_mesh(const Scene &scene, const Mesh &plane, SolidMesh &mesh);

  /// Receives what the first rank makes.
  bool receive_solid_mesh(SolidMesh &mesh);
} // namespace sprag
