#include "model/spring_excess.h"

#include <gtest/gtest.h>

using namespace sprag;

// Of k turn + 2e5 turn^3, which cubic interpolation meets exactly: the moment beyond k turn acts against the turn.
TEST(SpringExcess, ActsAgainstTheTurnWithItsTangent)
{
  const double k = 7e4, cubic = 2e5;
  std::vector<MomentLaw::Sample> samples;
  for (const double turn : { -0.2, 0., 0.2 })
    samples.push_back({ turn, k * turn + cubic * turn * turn * turn, k + 3. * cubic * turn * turn });
  const MomentLaw law(k, samples);
  for (const double turn : { -0.13, 0., 0.07 })
  {
    PortForces forces{ { 3, 8, 9 }, dealii::Vector<double>(3), dealii::FullMatrix<double>(3, 3) };
    forces.values        = 5.;
    forces.tangent(1, 1) = 11.;
    forces.tangent(2, 1) = 13.;
    add_spring_excess(law, 8, turn, forces);
    EXPECT_EQ(forces.values[0], 5.);
    EXPECT_NEAR(forces.values[1], 5. - cubic * turn * turn * turn, 1e-9);
    EXPECT_EQ(forces.values[2], 5.);
    EXPECT_NEAR(forces.tangent(1, 1), 11. - 3. * cubic * turn * turn, 1e-8);
    EXPECT_EQ(forces.tangent(2, 1), 13.);
    EXPECT_EQ(forces.tangent(1, 2), 0.);
  }
}
