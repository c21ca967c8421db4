// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "fe/body/friction_face.h"
#include "results/result_file.h"

#include <vector>

namespace sprag
{
  /// The parts of a friction face over which results tell means: in a plane its points, else four along xi of each of its cells,
  /// at each zeta of its points.
  struct FaceParts
  {
    FacePoints points;                     ///< their middles
    std::vector<unsigned int> point_parts; ///< of the face's points
  };

  FaceParts face_parts(const FrictionFace<2> &face);
  FaceParts face_parts(const FrictionFace<3> &face);
} // namespace sprag
