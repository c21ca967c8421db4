// SPDX-License-Identifier: GPL-3.0-only
#include "results/earlier_fields.h"

#include "base/pattern.h"

#include <filesystem>
#include <vector>

namespace sprag
{
  bool is_field_file(const std::string &name)
  {
    return matches(name, R"((fields|face|leaf|mode-\d+)(-\d+\.h5|-mesh\.h5|\.h5|\.xdmf))");
  }

  void remove_files(const std::string &folder, const std::function<bool(const std::string &)> &is_named_so)
  {
    std::vector<std::filesystem::path> found;
    for (const auto &entry : std::filesystem::directory_iterator(folder))
      if (is_named_so(entry.path().filename().string()))
        found.push_back(entry.path());
    for (const auto &path : found)
      std::filesystem::remove(path);
  }
} // namespace sprag
