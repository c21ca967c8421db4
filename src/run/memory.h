#pragma once

#include "scene/scene.h"

namespace sprag
{
  /// The size of a scene's finite-element model, estimated before there is a mesh.
  struct ExpectedSize
  {
    double displacements = 0.; ///< degrees of freedom
    double ports         = 0.; ///< the degrees of freedom on the friction face, which the contact acts on
  };

  /// Estimates the size of one lever, bar or frame, with an elastic cylinder, as meshes/ makes them. Both numbers are 0 where
  /// nothing is meshed, or the mesh is the user's.
  ExpectedSize expected_size(const Scene &scene);

  /// Estimates the number of rows of the table; of adaptive steps the fewest that there can be.
  double expected_rows(const Scene &scene);

  /// Estimates the largest resident memory of a run on `processes` processes [bytes], within 1.3 times what was measured:
  /// libraries, matrices of the meshed parts and rows kept for the summary.
  double expected_memory(const Scene &scene, unsigned int processes = 1);

  /// Throws InputError where expected_memory() exceeds what the system has left; the message tells both and what to change. It
  /// throws too where the run would have more than 1e7 rows, which no picture shows.
  void require_memory(const Scene &scene, unsigned int processes = 1);
} // namespace sprag
