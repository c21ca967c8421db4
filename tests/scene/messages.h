// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "input/read.h"
#include "scene/scene.h"
#include "support/thrown.h"
#include "support/written.h"

#include <gtest/gtest.h>
#include <string>
#include <vector>

namespace sprag
{
  // Scenes given as text or overrides, and what is said about them.

  using Messages = std::vector<std::string>;

  /// Returns the error messages about a scene, without the folder of its file.
  inline Messages mistakes(const std::string &text, const Messages &overrides = {})
  {
    return without_folder(thrown_messages([&] { read_scene(written(text), overrides); }));
  }

  /// Returns the error messages about the defaults with these overrides.
  inline Messages find_mistakes(const Messages &overrides)
  {
    return mistakes("", overrides);
  }

  inline Messages find_mistakes(Messages overrides, const Messages &more)
  {
    overrides.insert(overrides.end(), more.begin(), more.end());
    return find_mistakes(overrides);
  }

  /// Expects one message, about the last of the overrides.
  inline void expect_refused(const Messages &overrides, const std::string &rule)
  {
    const auto &wrong = overrides.back();
    const auto at     = wrong.find('=');
    EXPECT_EQ(find_mistakes(overrides), Messages{ "--set: " + wrong.substr(0, at) + " = " + wrong.substr(at + 1) + ": " + rule });
  }

  inline void expect_refused(Messages overrides, const Messages &more, const std::string &rule)
  {
    overrides.insert(overrides.end(), more.begin(), more.end());
    expect_refused(overrides, rule);
  }

  /// Geometry of model B.
  inline const Messages geometry_b = { "Geometry/Cylinder radius=21.1", "Geometry/Interface offset=0",
                                       "Geometry/Pivot distance=193.9" };

  inline Messages transient(const std::string &model)
  {
    return { "Analysis/Type=transient", "Analysis/Model=" + model };
  }

  inline Scene make_scene(const Messages &overrides)
  {
    return read_scene(written(""), overrides);
  }
} // namespace sprag
