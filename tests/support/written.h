// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "scene/scene.h"

#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <string>

namespace sprag
{
  /// The running test's.
  inline std::filesystem::path folder()
  {
    const auto *const test = testing::UnitTest::GetInstance()->current_test_info();
    const auto result      = std::filesystem::path(testing::TempDir()) / "sprag" / test->test_suite_name() / test->name();
    std::filesystem::create_directories(result);
    return result;
  }

  /// Path of a file there that holds the text.
  inline std::string written(const std::string &text, const std::string &name = "scene.prm")
  {
    std::ofstream(folder() / name) << text;
    return folder() / name;
  }

  /// The messages without the folder in them.
  inline std::vector<std::string> without_folder(std::vector<std::string> messages)
  {
    const std::string prefix = folder().string() + "/";
    for (auto &message : messages)
      for (auto found = message.find(prefix); found != std::string::npos; found = message.find(prefix))
        message.erase(found, prefix.size());
    return messages;
  }
} // namespace sprag
