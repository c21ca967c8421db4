// SPDX-License-Identifier: GPL-3.0-only
#include "scene/closed_form.h"
#include "laws/friction_law.h"

#include "scene/scene.h"
#include "scenes.h"
#include "support/work_of_drive.h"

#include <cmath>
#include <gtest/gtest.h>

using namespace sprag;

namespace
{
  const double pi = std::acos(-1.);

  /// Model A with its pivot off the path of the cylinder's centre.
  Scene raised_pivot(const double height)
  {
    Scene scene                 = model_a();
    scene.geometry.pivot_height = height;
    return scene;
  }

  std::vector<Geometry> geometries()
  {
    return { model_a().geometry, model_b().geometry, raised_pivot(5.).geometry, raised_pivot(-30.).geometry };
  }

  std::vector<Scene> scenes()
  {
    Scene harmonic = model_a();
    harmonic.drive = Drive(DriveProfile::harmonic, 0., 65., 180., 2.);
    Scene table    = model_b();
    table.drive    = Drive({ 0., 0.2, 0.5, 0.9, 1.1, 1.5, 2. }, { 0., 30., 60., 60., 20., 50., 0. });
    return { model_a(), model_b(), with_coulomb(model_a(), 1.), with_friction_by_drive_speed(model_a()),
             harmonic,  table,     raised_pivot(-30.) };
  }

  /// Five points: errs by h^4/30 f^(5), a few 1e-12 of f' for functions that vary over 100 mm, plus round-off of 1e-15 f/(h f').
  template <typename Function>
  double derivative(const Function &f, const double x)
  {
    const double h = 0.1;
    return (f(x - 2. * h) - 8. * f(x - h) + 8. * f(x + h) - f(x + 2. * h)) / (12. * h);
  }

  ClosedFormState at_turning_point(const Scene &scene, const double v)
  {
    return closed_form(scene, 65., v);
  }

  Scene driven_to(Scene scene, const double stroke)
  {
    scene.drive = Drive(DriveProfile::triangle, 0., stroke, 112., 1.);
    return scene;
  }

  /// Largest mu, for h = 0, at which the cylinder reaches the pivot before the lever locks.
  double locking_coefficient(const Geometry &geometry)
  {
    const double ratio = geometry.interface_offset / geometry.cylinder_radius;
    return std::sqrt((2. - ratio) / ratio);
  }

  /// Returns the same damper in metres, newtons and seconds.
  Scene in_metres(Scene scene)
  {
    auto &g = scene.geometry;
    g       = { g.cylinder_radius / 1e3, g.interface_offset / 1e3, g.pivot_distance / 1e3, g.pivot_height / 1e3 };
    scene.spring.stiffness /= 1e3;
    scene.drive = Drive(DriveProfile::triangle, 0., 0.065, 0.112, 1.);
    return scene;
  }
} // namespace

// Reference numbers are given to some printed digits; half a unit of the last of them is the tolerance.

TEST(ClosedForm, InclinationAtTheStartIsTheGeometricOne)
{
  EXPECT_NEAR(kinematics(model_a().geometry, 0.).theta * 180. / pi, 3.213955331, 5e-10);
  EXPECT_NEAR(kinematics(model_b().geometry, 0.).theta * 180. / pi, 6.247239360, 5e-10);
}

TEST(ClosedForm, InterfaceTouchesTheCircleAtTheContactPoint)
{
  // C = O + s d + e n = (x, 0) + R n, seen along both axes: lengths of 200 mm to round-off.
  for (const auto &g : geometries())
    for (const double x : { -10., 0., 30., 65., 110. })
    {
      const auto contact = kinematics(g, x);
      const double sine = std::sin(contact.theta), cosine = std::cos(contact.theta);
      const double arm = g.cylinder_radius - g.interface_offset;
      EXPECT_NEAR(g.pivot_distance - contact.s * cosine, x + arm * sine, 1e-12);
      EXPECT_NEAR(g.pivot_height + contact.s * sine, arm * cosine, 1e-12);
      EXPECT_GT(contact.s, 0.);
    }
}

TEST(ClosedForm, RateOfInclinationIsTheDerivativeOfInclination)
{
  for (const auto &g : geometries())
    for (const double x : { 0., 30., 65., 90. })
    {
      const double expected = derivative([&](const double at) { return kinematics(g, at).theta; }, x);
      EXPECT_NEAR(kinematics(g, x).theta_x, expected, 1e-10 * expected);
    }
}

TEST(ClosedForm, ForcesAtTheTurningPointAreTheReference)
{
  const Scene a = with_friction_by_drive_speed(model_a()), b = with_friction_by_drive_speed(model_b());
  EXPECT_NEAR(at_turning_point(a, 112.).mu, 0.72852016, 5e-9);
  EXPECT_NEAR(at_turning_point(a, 112.).P, 14.63888028, 5e-9);
  EXPECT_NEAR(at_turning_point(a, 112.).Q, 11.88836354, 5e-9);
  EXPECT_NEAR(at_turning_point(a, -112.).P, 25.84035609, 5e-9);
  EXPECT_NEAR(at_turning_point(a, -112.).Q, -16.52477063, 5e-9);
  EXPECT_NEAR(at_turning_point(b, 112.).P, 27.92519215, 5e-9);
  EXPECT_NEAR(at_turning_point(b, 112.).Q, 24.64080424, 5e-9);
  EXPECT_NEAR(at_turning_point(b, -112.).P, 27.92519215, 5e-9);
  EXPECT_NEAR(at_turning_point(b, -112.).Q, -15.49849929, 5e-9);
}

TEST(ClosedForm, SlidingSpeedIsBelowTheSpeedOfTheDrive)
{
  // Written out by hand: v_rel = 112 (cos th - 45.6 sin th/s) with th = asin(10.4/120.5), s = sqrt(120.5^2 - 10.4^2).
  const double s     = std::sqrt(120.5 * 120.5 - 10.4 * 10.4);
  const double speed = 112. * (s / 120.5 - 45.6 * 10.4 / 120.5 / s);
  const auto state   = at_turning_point(model_a(), -112.);
  EXPECT_NEAR(state.v_rel, -speed, 1e-12 * speed);
  EXPECT_NEAR(state.mu, friction_coefficient({ CorkOnAluminium{} }, speed).coefficient, 1e-15);
  // Falling mu unloads the lever by its self-servo effect: 0.511 % of P and 2.03 % of Q, from a second implementation.
  const auto by_drive = at_turning_point(with_friction_by_drive_speed(model_a()), -112.);
  EXPECT_NEAR(state.P, 25.70833178794652, 1e-11);
  EXPECT_NEAR(state.Q, -16.18988401659527, 1e-11);
  EXPECT_NEAR(1. - state.P / by_drive.P, 0.00511, 5e-6);
  EXPECT_NEAR(1. - state.Q / by_drive.Q, 0.0203, 5e-5);
}

TEST(ClosedForm, MomentsAboutThePivotBalance)
{
  for (const Scene &scene : scenes())
    for (const double v : { 112., -112. })
    {
      const auto state  = closed_form(scene, 50., v);
      const double turn = state.contact.theta - kinematics(scene.geometry, 0.).theta;
      const double M    = scene.spring.stiffness * turn;
      EXPECT_NEAR(state.contact.s * state.P + scene.geometry.interface_offset * state.F, M, 1e-13 * M);
      EXPECT_NEAR(std::abs(state.F), state.mu * state.P, 1e-14 * state.P);
    }
}

TEST(ClosedForm, LoopAreaIsTheReference)
{
  EXPECT_NEAR(loop_area(with_friction_by_drive_speed(model_a())), 677.8639225, 5e-8);
  EXPECT_NEAR(loop_area(with_friction_by_drive_speed(model_b())), 983.2653309, 5e-8);
}

TEST(ClosedForm, LoopAreaOfASmoothDriveIsTheReference)
{
  // From a second implementation, split by hand where mu(v) has its joints. A joint at 200 mm/s leaves a jump of 5.6e-5 of mu
  // that the quadrature finds only by bisection.
  Scene scene = with_friction_by_drive_speed(model_a());
  scene.drive = Drive(DriveProfile::harmonic, 0., 65., 112., 1.);
  EXPECT_NEAR(loop_area(scene), 596.8775636513263, 1e-9 * 596.);
  scene.drive = Drive(DriveProfile::harmonic, 0., 65., 300., 1.);
  EXPECT_NEAR(loop_area(scene), 824.6971991239793, 1e-8 * 824.);
}

TEST(ClosedForm, BackwardStrokeStopsDampingAtTheCriticalInclination)
{
  const double critical = std::atan(0.73);
  EXPECT_NEAR(critical * 180. / pi, 36.13, 5e-3); // as the paper has it
  // Above e/R = 1 - sin th0B = 0.41 the cylinder reaches the pivot before.
  for (const double ratio : { 0., 0.2, 0.4 })
    for (const double radius : { 1., 56. })
    {
      const auto slope = [&](const double theta)
      {
        const double arm = radius * (1. - ratio);
        return dimensionless_slope({ radius, radius * ratio, arm / std::sin(theta), 0. }, 0.73, -1);
      };
      EXPECT_NEAR(slope(critical), 0., 1e-14);
      EXPECT_LT(slope(critical - 1e-3), 0.);
      EXPECT_GT(slope(critical + 1e-3), 0.);
    }
}

TEST(ClosedForm, CylinderReachesThePivotAtItsRadius)
{
  EXPECT_NEAR(pivot_contact(model_a().geometry), 129.5, 1e-12);
  EXPECT_NEAR(pivot_contact(model_b().geometry), 172.8, 1e-12);
  for (const double height : { 5., -30. })
  {
    const Geometry g = raised_pivot(height).geometry;
    EXPECT_NEAR(std::hypot(g.pivot_distance - pivot_contact(g), height), g.cylinder_radius, 1e-12);
    EXPECT_LT(pivot_contact(g), g.pivot_distance);
  }
}

TEST(ClosedForm, LockingBeforeThePivotNeedsMoreFrictionThanCorkHas)
{
  const Geometry geometry = model_a().geometry;
  const double limit      = locking_coefficient(geometry);
  EXPECT_NEAR(limit, 1.2067, 5e-5);
  const double almost = pivot_contact(geometry) - 1e-3;
  // s^2 = (l-x)^2 - (R-e)^2 falls by 112 x 1e-3 mm^2 from the pivot's limit: 2e-5 of s, and so of mu.
  EXPECT_FALSE(locking(driven_to(with_coulomb(model_a(), 0.9999 * limit), almost)));
  EXPECT_TRUE(locking(driven_to(with_coulomb(model_a(), 1.0001 * limit), almost)));
  EXPECT_FALSE(locking(driven_to(with_coulomb(model_a(), 1.076), almost)));
  EXPECT_FALSE(locking(model_a()));
  EXPECT_FALSE(locking(driven_to(with_coulomb(model_b(), 100.), 172.)));
}

TEST(ClosedForm, LockingIsFoundWhereTheBackwardStrokeBegins)
{
  const auto found = locking(driven_to(with_coulomb(model_a(), 1.3), 128.));
  ASSERT_TRUE(found);
  EXPECT_EQ(found->x, 128.);
  EXPECT_EQ(found->mu, 1.3);
  EXPECT_NEAR(found->s, std::sqrt(57.5 * 57.5 - 10.4 * 10.4), 1e-12);
  // s = mu e at l - x = sqrt((1.3 e)^2 + (R-e)^2) = 60.185 mm, x = 125.315 mm.
  EXPECT_TRUE(locking(driven_to(with_coulomb(model_a(), 1.3), 125.316)));
  EXPECT_FALSE(locking(driven_to(with_coulomb(model_a(), 1.3), 125.314)));
}

TEST(ClosedForm, LockingIsFoundInTheMiddleOfAStrokeThatSpeedsUp)
{
  // Almost no lever arm, e/R = 0.964, and a drive that passes 750 mm/s soon after its reversal: mu = 1.076 finds s < mu e at
  // x > 185.5 - sqrt(58.104^2 + 2^2) = 127.362 mm, while mu(0) = 0.349 at the turning point does not.
  Scene scene      = with_friction_by_drive_speed(model_a());
  scene.geometry   = { 56., 54., 185.5, 0. };
  scene.drive      = Drive(DriveProfile::harmonic, 0., 129., 4000., 1.);
  const auto found = locking(scene);
  ASSERT_TRUE(found);
  EXPECT_LT(found->x, 129.);
  EXPECT_GT(found->x, 127.362);
  EXPECT_LE(found->s, found->mu * 54.);
  // First to 0.1 mm: s and mu e together change by less than 0.6 mm/mm here.
  EXPECT_GT(found->s, found->mu * 54. - 0.5);
}

TEST(ClosedForm, UnitsOfLengthDoNotMatter)
{
  // Products of a dozen factors: 1e-12 leaves them some round-off each.
  for (const Scene &mm : { with_coulomb(model_a(), 0.73), with_coulomb(model_b(), 0.73), with_coulomb(raised_pivot(5.), 0.73) })
  {
    const Scene m = in_metres(mm);
    for (const int sign : { 1, -1 })
    {
      const double slope = dimensionless_slope(mm.geometry, 0.73, sign);
      EXPECT_NEAR(dimensionless_slope(m.geometry, 0.73, sign), slope, 1e-12 * std::abs(slope));
      const auto in_mm = closed_form(mm, 65., sign * 112.), in_m = closed_form(m, 0.065, sign * 0.112);
      EXPECT_NEAR(in_m.P, in_mm.P, 1e-12 * in_mm.P);
      EXPECT_NEAR(in_m.Q, in_mm.Q, 1e-12 * std::abs(in_mm.Q));
      EXPECT_NEAR(in_m.contact.theta, in_mm.contact.theta, 1e-12 * in_mm.contact.theta);
    }
    EXPECT_NEAR(1e3 * loop_area(m), loop_area(mm), 1e-12 * loop_area(mm));
  }
}
