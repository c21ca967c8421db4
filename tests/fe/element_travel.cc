// SPDX-License-Identifier: GPL-3.0-only
#include "fe/contact/element_travel.h"

#include "bed_of_springs.h"
#include "mpi_environment.h"

#include <gtest/gtest.h>

#include <random>

using namespace sprag;

// Wherever nodes, lever, cylinder and axis go, no point comes nearer than the travel tells: neither below the rounded ends, where
// the profile is steep, nor anywhere else. Without slopes and ends it is little more than the points move.
TEST(ElementTravel, BoundsHowMuchNearerAnyPointComes)
{
  using Elements         = FaceElements<3>;
  const Cylinder rounded = barrel(true, 49., 1., 4000.);
  for (const bool has_profile : { true, false })
  {
    const Bed bed(rounded, 12.5, 4);
    const RigidCylinder cylinder(model_a().geometry, has_profile ? rounded : Cylinder());
    const Elements grid(bed.friction_face());
    std::mt19937 random(7);
    std::uniform_real_distribution<double> size(-1., 1.);
    double nearest = 0.; // share of the travel
    for (const auto &element : grid.elements)
    {
      ElementTravel<3> travel(140., 1.5625);
      Elements::Nodal nodes{};
      std::vector<double> first, gaps(element.end - element.begin);
      for (unsigned int k = 0; k < 30; ++k)
      {
        for (double &displacement : nodes)
          displacement += (k % 3 == 0 ? 1e-3 : 0.) * size(random);
        const double slope = has_profile && k % 5 == 0 ? 1e-4 * size(random) : 0.;
        const auto pose    = cylinder.pose(Bed::x + (k % 2 == 0 ? 0.01 * k : 0.), 0.085 - 1e-4 * k, { { slope, -slope } });
        travel.go_to(nodes, pose, cylinder.shape);
        for (unsigned int q = element.begin; q < element.end; ++q)
          gaps[q - element.begin] = cylinder.gap_and_gradient(pose, Elements::position(grid.points[q], nodes)).first;
        if (k == 0)
        {
          first = gaps;
          EXPECT_EQ(travel.length(), 0.);
        }
        for (unsigned int i = 0; i < gaps.size(); ++i)
        {
          EXPECT_LE(first[i] - gaps[i], travel.length());
          nearest = std::max(nearest, travel.length() > 0. ? (first[i] - gaps[i]) / travel.length() : 0.);
        }
      }
      EXPECT_EQ(travel.displacement(), nodes);
    }
    if (!has_profile)
    {
      EXPECT_GT(nearest, 0.3);
    }
  }
}

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
