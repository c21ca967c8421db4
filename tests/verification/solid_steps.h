// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "levers/dynamics.h"
#include "scene/scene.h"

#include <gtest/gtest.h>

namespace sprag
{
  /// The first 40 steps of a run in time, of 1e-4 s each.
  inline std::vector<Row> first_steps(const Scene &scene)
  {
    DynamicsMaker maker(false);
    const auto dynamics = maker.make(scene);
    auto motion         = dynamics.model().initial_motion(scene.drive.at(0.));
    std::vector<Row> result;
    for (unsigned int i = 1; i <= 40; ++i)
    {
      const double dt = 1e-4;
      auto outcome    = dynamics.model().step(motion, scene.drive.at(i * dt), StepWeights{ dt, 0., 0., 0.25, 0.5 });
      EXPECT_TRUE(outcome.motion);
      if (!outcome.motion)
        break;
      motion = *outcome.motion;
      dynamics.model().observe(motion, result.emplace_back());
    }
    return result;
  }
} // namespace sprag
