#pragma once

#include "scene/scene.h"

#include <string>
#include <vector>

namespace sprag
{
  // Texts that are equal for scenes which have something in common. They hold every parameter of the program, so that a new one
  // counts as long as nobody has shown that it does not. A file counts by what it holds, not by its name or time.

  /// All that a scene says. Of a scene that was read.
  std::string scene_key(const Scene &scene);

  /// All that the mesh of a scene's lever, its matrices and bases are made from: every parameter, as it was read and as it is in
  /// the scene now, but those of spared_parameters(); the ends of the drive; what is known of a leaf spring.
  std::string body_key(const Scene &scene);

  /// Parameters that mesh, matrices and bases do not depend on.
  struct Spared
  {
    std::string reason;
    std::vector<std::string> parameters; ///< "Section/Name"
  };

  const std::vector<Spared> &spared_parameters();
} // namespace sprag
