// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include <string>

namespace sprag
{
  /// Returns the path of a file that comes with the program, as "meshes/lever.geo": where it is installed, or else in its
  /// sources.
  std::string shipped_file(const std::string &name);
} // namespace sprag
