// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include <string>

namespace sprag
{
  /// Executes the program of this name in the folder of the running one in place of this process, with the same arguments. Throws
  /// InputError where that fails.
  [[noreturn]] void execute_beside(const std::string &name, char **arguments);
} // namespace sprag
