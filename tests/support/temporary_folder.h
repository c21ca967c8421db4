// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

namespace sprag
{
  /// An empty folder that is gone with its owner.
  class TemporaryFolder
  {
  public:
    TemporaryFolder()
        : path(::mkdtemp((std::filesystem::temp_directory_path() / "sprag-test-XXXXXX").string().data()))
    {
    }
    TemporaryFolder &operator=(TemporaryFolder &&) = delete;
    ~TemporaryFolder()
    {
      std::filesystem::remove_all(path);
    }

    /// Writes a file, in new folders where the name has any, and returns its path.
    std::string write(const std::string &name, const std::string &text) const
    {
      std::filesystem::create_directories((path / name).parent_path());
      std::ofstream(path / name) << text;
      return path / name;
    }

    const std::filesystem::path path;
  };
} // namespace sprag
