#pragma once

#include "scene/scene.h"

namespace sprag
{
  /// What the meshed parts of a scene will have, before there is a mesh.
  struct ExpectedSize
  {
    double displacements = 0.; ///< degrees of freedom
    double ports         = 0.; ///< of them those of the friction face
  };

  /// Of the built-in lever, bar or frame, and an elastic cylinder, as meshes/ makes them; one lever of a pair. Both are 0 where
  /// nothing is meshed, or the mesh is the user's.
  ExpectedSize expected_size(const Scene &scene);

  /// Largest resident memory of a run on `processes` processes [bytes], within a factor of two: libraries, matrices of the meshed
  /// parts and rows kept for the summary.
  double expected_memory(const Scene &scene, unsigned int processes = 1);

  /// Throws InputError where that is more than the system has left, with both numbers and what decides about them.
  void require_memory(const Scene &scene, unsigned int processes = 1);
} // namespace sprag
