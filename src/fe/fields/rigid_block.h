// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "fe/fields/device_mesh.h"

namespace sprag
{
  struct Scene;

  /// A rigid cylinder in a plane: kites between its middle and its rim. Positions are from its middle, along the axes of the
  /// world.
  DeviceBlock rigid_disc(const Scene &scene);

  /// A rigid cylinder in space, with tilt, skew, barrel and rounded ends: hexahedra over kites. One whose length is not given is
  /// drawn half as long again as the lever is wide.
  DeviceBlock rigid_tube(const Scene &scene);
} // namespace sprag
