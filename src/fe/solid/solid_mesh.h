#pragma once

#include "fe/body/dimension.h"
#include "scene/scene.h"

#include <deal.II/distributed/shared_tria.h>

namespace sprag
{
  /// A mesh of three dimensions, which every rank knows whole and shares the work on.
  using SolidMesh = dealii::parallel::shared::Triangulation<3>;

  /// Extrudes the plane mesh of the scene's lever over its width, or over a half of it where it is symmetric; zeta counts from
  /// the middle. Materials and boundaries keep their ids, the ends are free, that in the middle boundary_id::symmetry. To be
  /// called by all ranks; that of the first rank alone counts, the others need none. Throws InputError for cells without manifold
  /// or shape that can be extruded.
  void extrude(const Scene &scene, const Mesh &plane, SolidMesh &mesh);
} // namespace sprag
