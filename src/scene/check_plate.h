#pragma once

#include "scene/check.h"

namespace sprag
{
  /// What cannot be built of lever frame, friction plate, force sensors and guide. With a mesh of the user's own only what does
  /// not depend on the built-in outlines.
  void check_plate(const Scene &scene, bool own_mesh, Rules &rules);

  /// Parts of frame and plate that the cylinder does not fit, in a built-in outline. The drive must be in range.
  void check_sweep(const Scene &scene, Rules &rules);
} // namespace sprag
