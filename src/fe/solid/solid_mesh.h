#pragma once

#include "fe/body/dimension.h"
#include "scene/scene.h"

#include <deal.II/distributed/shared_tria.h>

namespace sprag
{
  /// A mesh of three dimensions, which every rank knows whole and shares the work on.
  using SolidMesh = dealii::parallel::shared::Triangulation<3>;

  /// Returns whether lever and cylinder are the same on both sides of the middle of the width, so that one half is enough.
  bool is_symmetric_across(const Scene &scene);

  /// Extrudes the plane mesh of the scene's lever over its width, or over a half of it where it is symmetric; zeta counts from
  /// the middle. Materials and boundaries keep their ids, the ends are free, that in the middle boundary_id::symmetry. To be
  /// called by all ranks; that of the first rank alone counts, the others need none. Throws InputError for cells without manifold
  /// or shape that can be extruded.
  void extrude(const Scene &scene, const Mesh &plane, SolidMesh &mesh);

  /// Returns the planes between the elements across the width, growing from both edges to the middle, or of the half [mm].
  std::vector<double> planes_across(const Scene &scene);
} // namespace sprag
