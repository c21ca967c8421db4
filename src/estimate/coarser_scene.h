// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "analytic/error_estimate.h"
#include "fe/contact/face_contact_point.h"

#include <functional>
#include <string>
#include <vector>

namespace sprag
{
  struct Scene;

  // Scenes whose results tell the error of another's, and the parts of that error.

  constexpr double softer  = 3.; ///< penalty of a run over that of its trial run
  constexpr double coarser = 2.; ///< face size of a trial run over that of its run; of a mesh from a file it is the inverse

  /// Says why no error can be estimated, the end of a sentence.
  struct NoEstimate
  {
    std::string reason;
  };

  /// Returns what `estimate` finds, or of all these quantities the reason why it finds none: a NoEstimate, a failure of a trial
  /// run or another mesh that is refused. A mesh from a file in three dimensions is compared with none.
  std::vector<ErrorEstimate> estimates_or_reason(const Scene &scene, const std::vector<std::string> &quantities,
                                                 const std::function<std::vector<ErrorEstimate>()> &estimate);

  /// Returns the scene with `share` > 0 of given penalties in place of automatic ones.
  Scene with_penalties(Scene scene, const ContactPenalties &penalties, double share);

  /// Returns the scene on a built-in mesh with larger faces of lever and cylinder, and fewer elements across.
  Scene with_coarser_mesh(Scene scene);

  /// Returns the scene on the mesh that tells the error of its own: the coarser one, or with a mesh from a file that of elements
  /// cut in four, as there is no coarser.
  Scene with_compared_mesh(Scene scene);

  /// Returns the order in which forces and frequencies converge with the face size: 2, and 1.6 with displacements of degree 1, as
  /// measured.
  double force_order(const Scene &scene);

  /// Returns the order in which pressures do: 3, and 2 of the augmented Lagrangian, whose averaged tractions follow a narrow
  /// contact less closely, as measured.
  double pressure_order(const Scene &scene);

  /// Returns the part of the mesh, change/(r^order - 1) by Richardson, from the change on with_compared_mesh() with faces r times
  /// as long; of the coarser of two meshes with a mesh from a file.
  ErrorPart mesh_part(const Scene &scene, double change, double order);

  /// Returns the part of the penalty, change/(r - 1) from the change with a penalty softer by r; the error is proportional to
  /// 1/penalty.
  ErrorPart penalty_part(const Scene &scene, double change);
} // namespace sprag
