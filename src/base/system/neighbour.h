// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include <string>

namespace sprag
{
  /// Becomes the program of this name in the folder of the running one, with the same arguments. Throws InputError where that
  /// fails.
  [[noreturn]] void become_neighbour(const std::string &name, char **arguments);
} // namespace sprag
