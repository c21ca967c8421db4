#pragma once

#include "scene/check.h"

namespace sprag
{
  /// What cannot be built of lever frame, friction plate, force sensors and guide. With a mesh of the user's own only what does
  /// not depend on the built-in outlines.
  std::vector<Violation> plate_violations(const Scene &scene, bool own_mesh);

  /// Parts of frame and plate that the cylinder does not fit, in a built-in outline. The drive must be in range.
  std::vector<Violation> sweep_violations(const Scene &scene);
} // namespace sprag
