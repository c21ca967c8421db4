// SPDX-License-Identifier: GPL-3.0-only
#include "model/step/force_history.h"

#include <gtest/gtest.h>

using namespace sprag;

namespace
{
  DofLoads loads(const std::vector<unsigned int> &dofs, const std::vector<double> &values)
  {
    return { dofs, dealii::Vector<double>(values.begin(), values.end()) };
  }
} // namespace

// f(t) = 2 + 3 t at the middles of steps of 1, 2 and 4: at 0.5, 2 and 5.
TEST(ForceHistory, FollowsALineThroughStepsOfDifferentLength)
{
  ForceHistory history;
  history.begin(loads({ 4 }, { 2. }));
  EXPECT_EQ(history.guess(1.).values[0], 2.);
  history.accept(loads({ 4 }, { 3.5 }), 1.);
  EXPECT_DOUBLE_EQ(history.guess(2.).values[0], 8.);
  history.accept(loads({ 4 }, { 8. }), 2.);
  EXPECT_DOUBLE_EQ(history.guess(4.).values[0], 17.);
}

TEST(ForceHistory, HasTheDofsOfTheLastForces)
{
  ForceHistory history;
  history.begin(loads({ 1, 2 }, { 1., 1. }));
  history.accept(loads({ 1, 2 }, { 1., 1. }), 1.);
  history.accept(loads({ 2, 7 }, { 2., 5. }), 1.);
  const auto found = history.guess(1.);
  EXPECT_EQ(found.dofs, (std::vector<unsigned int>{ 2, 7 }));
  EXPECT_DOUBLE_EQ(found.values[0], 13. / 3.);
  EXPECT_DOUBLE_EQ(found.values[1], 5.);
}

// f(t) = 1 + t^2 through three steps: the oldest of four is forgotten.
TEST(ForceHistory, FollowsAParabolaThroughSteps)
{
  ForceHistory history;
  history.begin(loads({ 4 }, { 100. }));
  for (const double t : { 0.5, 2., 5. })
    history.accept(loads({ 4 }, { 1. + t * t }), t == 0.5 ? 1. : t == 2. ? 2. : 4.);
  EXPECT_DOUBLE_EQ(history.guess(2.).values[0], 1. + 8. * 8.);
}
