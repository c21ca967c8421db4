// SPDX-License-Identifier: GPL-3.0-only
#include "base/shipped_file.h"

#include <filesystem>

namespace sprag
{
  std::string shipped_file(const std::string &name)
  {
    std::error_code error;
    const auto program   = std::filesystem::read_symlink("/proc/self/exe", error);
    const auto installed = program.parent_path() / SPRAG_INSTALLED / name;
    return std::filesystem::is_regular_file(installed, error) ? installed.lexically_normal().string() : SPRAG_SOURCES "/" + name;
  }
} // namespace sprag
