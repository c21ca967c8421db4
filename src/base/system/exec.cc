// SPDX-License-Identifier: GPL-3.0-only
#include "base/system/exec.h"

#include "base/errors.h"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <unistd.h>

namespace sprag
{
  void execute_beside(const std::string &name, char **arguments)
  {
    const auto program = std::filesystem::read_symlink("/proc/self/exe").replace_filename(name);
    ::execv(program.c_str(), arguments);
    throw InputError(program.string() + " cannot be run: " + std::strerror(errno) + ": it must lie beside sprag");
  }
} // namespace sprag
