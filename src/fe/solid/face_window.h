// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "fe/body/friction_face.h"

namespace sprag
{
  /// A part of a friction face in three dimensions as a face of its own.
  struct FaceWindow
  {
    FrictionFace<3> face;
    unsigned int first_node; ///< number of its first node in the whole face; the others follow
  };

  /// Returns the part whose patches reach into `begin` ... `end` along xi [mm]. The face's nodes increase along xi. Throws
  /// AnalysisError where there is no such patch.
  FaceWindow window_of(const FrictionFace<3> &face, double begin, double end);
} // namespace sprag
