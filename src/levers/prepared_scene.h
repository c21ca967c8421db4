// SPDX-License-Identifier: GPL-3.0-only
#pragma once

namespace sprag
{
  struct Scene;

  /// Returns the scene with the behaviour of its meshed spring, which levers of every fidelity need. Throws InputError where the
  /// parts do not fit together then, AnalysisError where the spring cannot be solved.
  Scene prepared(const Scene &scene);

  /// Returns the scene with what its Mesh/File has in place of Mesh/Face size, own_face_size(), where it uses one. Throws
  /// InputError for a file that cannot serve.
  Scene with_own_face_size(Scene scene);
} // namespace sprag
