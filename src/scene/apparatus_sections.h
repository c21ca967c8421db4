#pragma once

#include "base/parameters.h"
#include "scene/scene.h"

#include <vector>

namespace sprag
{
  /// Parameters of the parts of the apparatus: spring, lever frame, friction plate, cylinder. As scene_parameters().
  void add_apparatus_parameters(Scene &scene, std::vector<Parameter> &all);
} // namespace sprag
