// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "scene/sections.h"

namespace sprag
{
  /// Sets the face size, the number of faces in contact and the enforcement of contact of the scene that are read from its other
  /// settings where they are left to the program.
  void make_discretisation(SceneSettings &settings);
} // namespace sprag
