#pragma once

#include "scene/scene.h"

namespace sprag
{
  /// The scene with what its meshed spring does, at every fidelity known. Throws InputError where the parts do not fit together
  /// then, AnalysisError where the spring cannot be solved.
  Scene prepared(const Scene &scene);
} // namespace sprag
