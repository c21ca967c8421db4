#include "scene/drive.h"

#include "base/errors.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

using namespace sprag;

namespace
{
  const double pi = std::acos(-1.);

  /// All points of a drive walked through in steps of dx, its start included.
  std::vector<DrivePoint> walk(const Drive &drive, const double dx)
  {
    std::vector<DrivePoint> points = { drive.at(0.) };
    while (points.back().time < drive.duration() && points.size() < 100000)
      points.push_back(drive.step(points.back().time, dx));
    return points;
  }

  void expect_walk_keeps_its_promises(const Drive &drive, const double dx)
  {
    const auto points    = walk(drive, dx);
    const auto reversals = drive.reversals();
    for (std::size_t i = 1; i < points.size(); ++i)
    {
      EXPECT_GT(points[i].time, points[i - 1].time);
      EXPECT_LE(std::abs(points[i].x - points[i - 1].x), 1.001 * dx + 1e-12);
    }
    for (const double reversal : reversals)
      EXPECT_TRUE(std::any_of(points.begin(), points.end(), [&](const auto &point) { return point.time == reversal; }));
    EXPECT_EQ(points.back().time, drive.duration());
  }

  Drive rise_rest_fall()
  {
    return Drive({ 0., 1., 2., 3., 4., 5. }, { 0., 20., 20., 30., 30., 5. });
  }
} // namespace

TEST(Drive, DefaultGoesSixtyFiveMillimetresAndBack)
{
  const Drive drive;
  EXPECT_EQ(drive.profile(), DriveProfile::triangle);
  EXPECT_EQ(drive.minimum(), 0.);
  EXPECT_EQ(drive.maximum(), 65.);
  EXPECT_EQ(drive.peak_speed(), 112.);
  EXPECT_DOUBLE_EQ(drive.duration(), 130. / 112.);
  ASSERT_EQ(drive.reversals().size(), 1u);
  EXPECT_DOUBLE_EQ(drive.reversals()[0], 65. / 112.);
}

TEST(Drive, TriangleHasTwoSpeedsAtItsReversal)
{
  const Drive drive(DriveProfile::triangle, 3., 60.1, 112., 2.);
  ASSERT_EQ(drive.reversals().size(), 3u);
  const double turn = drive.reversals()[0];
  EXPECT_EQ(drive.at(turn, Drive::Side::before).v, 112.);
  EXPECT_EQ(drive.at(turn, Drive::Side::after).v, -112.);
  EXPECT_EQ(drive.at(turn, Drive::Side::before).x, 60.1);
  EXPECT_EQ(drive.at(turn, Drive::Side::after).x, 60.1);
  EXPECT_EQ(drive.at(0., Drive::Side::before).v, 112.);
  EXPECT_EQ(drive.at(drive.duration(), Drive::Side::after).v, -112.);
}

TEST(Drive, TurningPointsAreHitBitForBit)
{
  for (const auto profile : { DriveProfile::triangle, DriveProfile::harmonic })
    for (const double dx : { 0.1, 0.37, 1., 7., 1000. })
    {
      const Drive drive(profile, 0.3, 64.7, 97.3, 2.5);
      expect_walk_keeps_its_promises(drive, dx);
      for (std::size_t i = 0; i < drive.reversals().size(); ++i)
        EXPECT_EQ(drive.at(drive.reversals()[i]).x, i % 2 == 0 ? 64.7 : 0.3);
      EXPECT_EQ(drive.at(drive.duration()).x, 64.7);
    }
}

TEST(Drive, StepMovesByWhatWasAskedFor)
{
  for (const auto profile : { DriveProfile::triangle, DriveProfile::harmonic })
  {
    const Drive drive(profile, 0., 65., 112., 1.);
    for (const auto &point : walk(drive, 1.))
      EXPECT_NEAR(point.x, std::round(point.x), 1e-9);
    EXPECT_EQ(walk(drive, 1.).size(), 131u);
  }
}

TEST(Drive, SliverBeforeAReversalIsTakenAlong)
{
  const Drive drive(DriveProfile::triangle, 0., 10.0005, 100., 1.);
  EXPECT_EQ(walk(drive, 1.).size(), 21u);
  EXPECT_EQ(walk(Drive(DriveProfile::triangle, 0., 10.01, 100., 1.), 1.).size(), 23u);
}

TEST(Drive, StepAtTheEndStays)
{
  const Drive drive;
  EXPECT_EQ(drive.step(drive.duration(), 1.).time, drive.duration());
}

TEST(Drive, CyclesCountThereAndBack)
{
  EXPECT_TRUE(Drive(DriveProfile::triangle, 0., 65., 112., 0.5).reversals().empty());
  EXPECT_EQ(Drive(DriveProfile::triangle, 0., 65., 112., 1.).reversals().size(), 1u);
  EXPECT_EQ(Drive(DriveProfile::harmonic, 0., 65., 112., 3.).reversals().size(), 5u);
  const Drive part(DriveProfile::triangle, 0., 60., 100., 0.75);
  EXPECT_DOUBLE_EQ(part.at(part.duration()).x, 30.);
  EXPECT_DOUBLE_EQ(part.maximum(), 60.);
}

TEST(Drive, HarmonicFollowsItsFormula)
{
  const double speed = 112., stroke = 65.;
  const double omega = 2. * speed / stroke;
  const Drive drive(DriveProfile::harmonic, 0., stroke, speed, 2.);
  EXPECT_NEAR(drive.duration(), 4. * pi / omega, 1e-12);
  for (double t = 0.01; t < drive.duration(); t += 0.01)
  {
    EXPECT_NEAR(drive.at(t).x, stroke / 2. * (1. - std::cos(omega * t)), 1e-11);
    EXPECT_NEAR(drive.at(t).v, speed * std::sin(omega * t), 1e-10);
  }
}

TEST(Drive, TableReversesWhereItsSamplesTurn)
{
  const Drive drive = rise_rest_fall();
  // After the rest at 30 mm the direction changes when the motion sets in again; the rest at 20 mm is no reversal.
  EXPECT_EQ(drive.reversals(), std::vector<double>{ 4. });
  EXPECT_EQ(drive.minimum(), 0.);
  EXPECT_EQ(drive.maximum(), 30.);
  EXPECT_EQ(drive.duration(), 5.);
}

TEST(Drive, TableStepsEndAtBothEndsOfARest)
{
  const Drive drive = rise_rest_fall();
  expect_walk_keeps_its_promises(drive, 3.);
  std::vector<double> whole_seconds;
  for (const auto &point : walk(drive, 3.))
    if (point.time == std::round(point.time))
      whole_seconds.push_back(point.time);
  EXPECT_EQ(whole_seconds, (std::vector<double>{ 0., 1., 2., 3., 4., 5. }));
  EXPECT_EQ(drive.step(1., 3.).time, 2.);
  EXPECT_EQ(drive.at(1.5).v, 0.);
}

TEST(Drive, TablePeakSpeedIsTheLargestOfAll)
{
  const Drive drive({ 0., 0.3, 1., 1.1, 2., 3. }, { 0., 20., 15., 40., 41., 5. });
  double largest = 0.;
  for (double t = 0.; t <= 3.; t += 1e-5)
    largest = std::max(largest, std::abs(drive.at(t).v));
  EXPECT_NEAR(drive.peak_speed(), largest, 1e-4 * largest);
  EXPECT_GE(drive.peak_speed(), largest - 1e-9);
}

TEST(Drive, TableThatIsNoneIsRefused)
{
  EXPECT_THROW(Drive({ 0., 1., 2. }, { 0., 1., 2. }), InputError);
  EXPECT_THROW(Drive({ 1., 2., 3., 4. }, { 0., 1., 2., 3. }), InputError);
  EXPECT_THROW(Drive({ 0., 2., 2., 4. }, { 0., 1., 2., 3. }), InputError);
  EXPECT_THROW(Drive({ 0., 1., 2., 4. }, { 1., 1., 1., 1. }), InputError);
}
