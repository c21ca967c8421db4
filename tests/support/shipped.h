// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "input/read.h"
#include "scene/scene.h"
#include "support/params_folder.h"

#include <string>
#include <vector>

namespace sprag
{
  /// Returns a scene of params/ with changes.
  inline Scene shipped(const std::string &name, const std::vector<std::string> &changes = {})
  {
    return read_scene((params_folder() / (name + ".prm")).string(), changes);
  }
} // namespace sprag
