// SPDX-License-Identifier: GPL-3.0-only
#include "fe/contact/element_travel.h"

#include "bed_of_springs.h"
#include "mpi_environment.h"

#include <gtest/gtest.h>

#include <random>

using namespace sprag;

// An iteration that diverged once must not hide what comes after it.
TEST(ElementTravel, IsEndlessFromFarAwayOn)
{
  const RigidCylinder cylinder(model_a().geometry, Cylinder());
  const double nowhere = std::nan("");
  for (const double far : { 1e17, 1e200, nowhere })
  {
    ElementTravel<3> travel(140., 1.5625);
    ElementTravel<3>::Nodal nodes{};
    const auto go = [&] { travel.go_to(nodes, cylinder.pose(Bed::x, 0.085), cylinder.shape); };
    go();
    nodes[1] = far;
    go();
    nodes[1] = 0.;
    go();
    EXPECT_EQ(travel.length(), std::numeric_limits<double>::infinity());
  }
}
