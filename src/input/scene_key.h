// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include <set>
#include <string>

namespace sprag
{
  struct Scene;

  // Texts that are equal for scenes which have something in common. They hold every parameter of the program, so that a new one
  // counts as long as nobody has shown that it does not. A file counts by what it holds, not by its name or time.

  /// Returns all that a scene says, for a scene that was read; of a study the files that it varies too.
  std::string scene_key(const Scene &scene);

  /// Returns all that the mesh of a scene's lever, its matrices and bases are made from: every parameter, as it was read and as
  /// it is in the scene now, but those of spared_sections() and spared_parameters(); the ends of the drive; how the faces
  /// are graded, which follows from P and so from friction and speed; what is known of a leaf spring.
  std::string body_key(const Scene &scene);

  // Mesh, matrices and bases depend on no parameter of these sections, and on none of these "Section/Name".
  const std::set<std::string> &spared_sections();
  const std::set<std::string> &spared_parameters();
} // namespace sprag
