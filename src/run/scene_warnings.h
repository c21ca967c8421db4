#pragma once

#include "results/warning.h"
#include "scene/scene.h"

namespace sprag
{
  /// Returns the warnings that follow from the scene alone, before anything is computed. The scene is a prepared() one.
  Warnings scene_warnings(const Scene &scene);
} // namespace sprag
