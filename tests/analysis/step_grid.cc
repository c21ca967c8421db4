// SPDX-License-Identifier: GPL-3.0-only
#include "analysis/isolation/lever_table.h"

#include <cmath>
#include <gtest/gtest.h>
#include <random>
#include <set>

using namespace sprag;

namespace
{
  /// Takes steps of random length through spans of 0.01 s and returns their durations.
  std::set<double> step_durations(StepGrid grid)
  {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> exponent(-12., 0.);
    std::set<double> durations;
    double time = 0.3;
    for (unsigned int span = 0; span < 200; ++span)
    {
      const double end = 0.3 + 0.01 * (span + 1);
      EXPECT_TRUE(grid.needs_span(end));
      grid.begin(time, end, 5e-4);
      for (double last = time; !grid.is_finished(); last = time)
      {
        const double target = 5e-4 * std::exp2(exponent(random));
        grid.choose(target);
        EXPECT_LE(grid.duration(), target * (1. + 1e-6));
        time = grid.step_end();
        EXPECT_NEAR(time - last, grid.duration(), 1e-8 * grid.duration() + 1e-15);
        durations.insert(grid.duration());
        grid.advance();
      }
      EXPECT_EQ(time, end);
      EXPECT_TRUE(grid.needs_span(end));
    }
    return durations;
  }
} // namespace

TEST(StepGrid, StepsOfAnyLengthMeetTheEndInFewDurations)
{
  StepGrid grid;
  EXPECT_LE(step_durations(grid).size(), 26u); // 1, 2, 3, 4, 6, 8 ... 4096, 6144 parts
  grid.use_halves_alone();
  EXPECT_LE(step_durations(grid).size(), 14u); // 1, 2, 4, 8 ... 8192 parts
}

TEST(StepGrid, AnUnfinishedSpanGoesOn)
{
  StepGrid grid;
  grid.begin(0., 1., 0.5);
  grid.choose(0.5);
  EXPECT_DOUBLE_EQ(grid.step_end(), 0.5);
  grid.advance();
  EXPECT_FALSE(grid.needs_span(1.));
  EXPECT_TRUE(grid.needs_span(0.9));
}

TEST(StepGrid, ShorterStepsAreBetweenHalfAndTwoThirds)
{
  StepGrid grid;
  grid.begin(0., 1., 1.);
  for (unsigned int i = 0; i < 20; ++i)
  {
    const double before = grid.duration();
    grid.shorten();
    EXPECT_LE(grid.duration(), before * (2. / 3. + 1e-6));
    EXPECT_GE(grid.duration(), before * (0.5 - 1e-6));
    if (i % 3 == 0)
      grid.advance();
  }
}
