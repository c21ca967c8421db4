// SPDX-License-Identifier: GPL-3.0-only
#include "fe/contact/face_contact.h"
#include "laws/friction_law.h"

#include "bar_on_elastic_cylinder.h"
#include "mpi_environment.h"
#include "pressed_step.h"
#include "support/interface_differences.h"

#include <gtest/gtest.h>

using namespace sprag;

namespace
{
  using Vector = dealii::Vector<double>;

  /// A rigid or an elastic cylinder.
  class FaceContactOn : public testing::TestWithParam<std::string>
  {
  protected:
    FaceProperties properties(const bool sprung, const double regularisation_speed) const
    {
      return make_properties(body, sprung, regularisation_speed);
    }

    PressedStep step(FaceContact<2> &contact, const InterfaceLayout &layout, const double x, const double share = 1.,
                     const double spectral_radius = 0.8) const
    {
      return { contact, body, layout, size, x, share, spectral_radius };
    }

    const MeshedBar bar{ bar_on_cylinder() };
    const MeshedPair pair;
    const bool elastic         = GetParam() == "elastic";
    const ElasticBody<2> &body = elastic ? *pair : *bar;
    const double size          = elastic ? 2e-4 : 1e-3; ///< of displacements [mm]
    // Points are 0.05 mm apart and the penetration falls to 0 at a slope of some 0.05: of the points one in some 1e4 changes
    // state by 1e-7 mm, so that a difference is that of a smooth function. On an elastic cylinder the covariance of stretch and
    // slip within a facet, some 1e-3 of 1e-3, is not in the tangent.
    const double tolerance = elastic ? 1e-5 : 1e-6;
  };
} // namespace

INSTANTIATE_TEST_SUITE_P(Cylinder, FaceContactOn, testing::Values("rigid", "elastic"),
                         [](const auto &test) { return test.param; });

TEST_P(FaceContactOn, TangentIsTheDerivativeOfTheForces)
{
  for (const bool sprung : { false, true })
    for (const double regularisation : { 0., 20. })
      // Sliding on, sticking, sliding back.
      for (const double x : { 1.01, 1.0003, 0.99 })
      {
        const auto contact_properties = properties(sprung, regularisation);
        FaceContact<2> contact(body.friction_face(), contact_properties, body.cylinder_face());
        auto taken = step(contact, contact_properties.layout, x);
        FaceEvaluation<2> found;
        EXPECT_LE(tangent_error(found.forces, taken.end, [&] { contact.evaluate(*taken, found); }), tolerance)
            << sprung << " " << x;
        EXPECT_GT(found.forces.dofs.size(), elastic ? 20u : 10u);
      }
}

TEST_P(FaceContactOn, TangentOfSteadySlidingIsTheDerivativeOfTheForces)
{
  for (const bool sprung : { false, true })
    for (const double speed : { 100., -100. })
    {
      const auto contact_properties = properties(sprung, 0.);
      FaceContact<2> contact(body.friction_face(), contact_properties, body.cylinder_face());
      const auto taken     = step(contact, contact_properties.layout, 1.01);
      Vector displacements = taken.end;
      FaceEvaluation<2> found;
      EXPECT_LE(tangent_error(found.forces, displacements,
                              [&] {
                                contact.evaluate_sliding({ displacements, taken.to, speed }, found);
                              }),
                tolerance)
          << speed;
    }
}

TEST_P(FaceContactOn, ApartNothingHappens)
{
  const auto contact_properties = properties(false, 0.);
  FaceContact<2> contact(body.friction_face(), contact_properties, body.cylinder_face());
  Vector displacements(contact_properties.layout.size());
  displacements[contact_properties.layout.rotation()] = 0.02;
  FaceEvaluation<2> found;
  contact.touch(displacements, { 0., 0., 0. }, found);
  EXPECT_TRUE(found.history().empty());
  EXPECT_TRUE(found.forces.dofs.empty());
  EXPECT_EQ(found.energy(), 0.);
  Row row;
  contact.observe(found, row);
  EXPECT_EQ(row[Column::P], 0.);
  EXPECT_EQ(row[Column::Q], 0.);
  EXPECT_EQ(row[Column::contact_width], 0.);
  // Turned further the gap grows by the arm, some 12 mm.
  Vector change(displacements.size());
  change[contact_properties.layout.rotation()] = 1e-6;
  EXPECT_NEAR(contact.gap_change(found, change), 12e-6, 1e-6);
}

TEST(FaceContact, FindsAllPointsInReach)
{
  const MeshedBar bar(bar_on_cylinder());
  const auto properties = make_properties(*bar, false, 0.);
  const FaceElements<2> face((*bar).friction_face());
  FaceContact<2> contact((*bar).friction_face(), properties);
  const double R = cylinder_below_bar().cylinder_radius;
  for (const double x : { -6., -3., 0., 3., 6. })
    for (const double turn : { 0., -0.01, -0.1, 0.2 })
    {
      auto displacements                          = pressed(*bar, properties.layout, 1e-3, 0., 3.);
      displacements[properties.layout.rotation()] = turn;
      const auto centre                           = cylinder_centre(cylinder_below_bar(), x, rest_inclination + turn);
      FaceEvaluation<2> found;
      contact.touch(displacements, { 0., x, 0. }, found);
      ASSERT_FALSE(found.points.empty());
      double inside = 1e9, outside = 1e9;
      for (unsigned int q = 0; q < face.points.size(); ++q)
      {
        const auto nodal    = FaceElements<2>::nodal(face.elements[face.point_elements[q]], displacements);
        const auto position = FaceElements<2>::position(face.points[q], nodal);
        const double gap    = std::hypot(position[0] - centre.xi, position[1] - centre.eta) - R;
        const bool is_found =
            std::any_of(found.points.begin(), found.points.end(), [&](const auto &at) { return at.index == q; });
        double &least = is_found ? inside : outside;
        least         = std::min(least, gap);
      }
      EXPECT_GT(outside, 0.) << x << " " << turn;
      EXPECT_LE(inside, outside + 0.02 * face.elements.front().length) << x << " " << turn;
    }
}

// A step without movement, all weight on its end, that begins without friction.
TEST(FaceContact, StuckIsTheTangentOfAStepInStick)
{
  const MeshedBar bar(bar_on_cylinder());
  const auto properties = make_properties(*bar, true, 0.);
  FaceContact<2> contact((*bar).friction_face(), properties);
  const PressedStep step(contact, *bar, properties.layout, 1e-3, 1.01);
  const Vector rest(step.end.size());
  FaceEvaluation<2> slide, stick;
  const auto linear = contact.linearise({ step.end, step.to, 100., nullptr, ContactFriction::stuck }, slide);
  contact.evaluate({ step.to, {}, step.to, { step.end, rest, rest }, step.end, rest, StepWeights{ 1e-5, 0., 0., 0.25, 0.5 } },
                   stick);
  ASSERT_EQ(stick.forces.dofs, linear.dofs);
  auto difference = linear.stiffness();
  difference.add(-1., stick.forces.tangent);
  EXPECT_LT(difference.frobenius_norm(), 1e-12 * linear.stiffness().frobenius_norm());
}
