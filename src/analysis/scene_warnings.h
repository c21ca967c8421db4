#pragma once

#include "results/warning.h"
#include "scene/scene.h"

namespace sprag
{
  /// What follows from the scene alone, before anything is computed. The scene with what its meshed spring does, see prepared().
  Warnings scene_warnings(const Scene &scene);
} // namespace sprag
