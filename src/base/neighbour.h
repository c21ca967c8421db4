#pragma once

#include <string>

namespace sprag
{
  /// Becomes the program of this name in the folder of the running one, with the same arguments, and lets its
  /// BLAS use all that the processor has. Throws std::runtime_error where that fails.
  [[noreturn]] void become_neighbour(const std::string &name, char **arguments);
} // namespace sprag
