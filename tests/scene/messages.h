#pragma once

#include "base/errors.h"
#include "scene/read.h"

#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <string>
#include <vector>

namespace sprag
{
  // Scenes given as text or overrides, and what is said about them.

  using Messages = std::vector<std::string>;

  inline std::filesystem::path folder()
  {
    const auto *const test = testing::UnitTest::GetInstance()->current_test_info();
    const auto result      = std::filesystem::path(testing::TempDir()) / "sprag" / test->test_suite_name() / test->name();
    std::filesystem::create_directories(result);
    return result;
  }

  inline std::string written(const std::string &text, const std::string &name = "scene.prm")
  {
    const auto file = (folder() / name).string();
    std::ofstream(file) << text;
    return file;
  }

  /// What is wrong with a scene, the folder of its file left out.
  inline Messages mistakes(const std::string &text, const Messages &overrides = {})
  {
    const std::string prefix = folder().string() + "/";
    Messages result;
    try
    {
      read_scene(written(text), overrides);
    }
    catch (const InputError &error)
    {
      for (auto message : error.messages)
      {
        for (auto found = message.find(prefix); found != std::string::npos; found = message.find(prefix))
          message.erase(found, prefix.size());
        result.push_back(message);
      }
    }
    return result;
  }

  /// Of the defaults with these overrides.
  inline Messages mistakes_of(const Messages &overrides)
  {
    return mistakes("", overrides);
  }

  inline Messages mistakes_of(Messages overrides, const Messages &more)
  {
    overrides.insert(overrides.end(), more.begin(), more.end());
    return mistakes_of(overrides);
  }

  inline Messages transient(const std::string &model)
  {
    return { "Analysis/Type=transient", "Analysis/Model=" + model };
  }

  inline Scene scene_of(const Messages &overrides)
  {
    return read_scene(written(""), overrides);
  }
} // namespace sprag
