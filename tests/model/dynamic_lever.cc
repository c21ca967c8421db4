// SPDX-License-Identifier: GPL-3.0-only
#include "model/lever/dynamic_lever.h"

#include <gtest/gtest.h>

using namespace sprag;

// Near a fold the share is a parabola over the penetration, 1 - (1 - d)^2, here 1e-4 away at d = 0.99; at its last points the
// penetration is off by 1e-7, as where an element comes into contact.
TEST(DistanceToFold, IsThatOfAParabolaWhateverTheLastStepsAre)
{
  std::vector<BranchPoint> branch;
  for (const double d : { 0., 0.2, 0.5, 0.7, 0.85, 0.95, 0.98, 0.99 - 1e-6, 0.99 - 5e-7, 0.99 })
    branch.push_back({ 1. - (1. - d) * (1. - d), d });
  branch[8].penetration += 1e-7;
  EXPECT_NEAR(distance_to_fold(branch), 1e-4, 1e-6);
}

// The force of a lever grows as 1/(1 - share) where it does not bend: a branch that ends half way is far from where it locks.
TEST(DistanceToFold, IsLargeWhereABranchGoesOn)
{
  std::vector<BranchPoint> branch;
  for (const double share : { 0., 0.1, 0.2, 0.3, 0.4, 0.5 })
    branch.push_back({ share, 1. / (1. - share) });
  EXPECT_GT(distance_to_fold(branch), 0.05);
  branch.resize(2);
  EXPECT_GT(distance_to_fold(branch), 1.);
}
