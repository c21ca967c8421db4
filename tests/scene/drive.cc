// SPDX-License-Identifier: GPL-3.0-only
#include "scene/drive.h"

#include "base/errors.h"
#include "scene/scene.h"
#include "scenes.h"
#include "support/work_of_drive.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <gtest/gtest.h>
#include <limits>

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

  /// Model A's triangle with reversals that take their time.
  Drive smooth(const double start, const double cycles, const double reversal_duration = 5e-3)
  {
    return Drive(DriveProfile::triangle, start, 65., 112., cycles, reversal_duration);
  }

  std::vector<Drive> all_drives()
  {
    return { smooth(0., 0.5),
             smooth(0., 1.),
             smooth(20., 1.5),
             smooth(0., 2., 0.2),
             smooth(20., 0.75, 0.05),
             Drive(DriveProfile::triangle, 0., 65., 112., 1.),
             Drive(DriveProfile::harmonic, 3., 65., 112., 1.2),
             Drive({ 0., 0.3, 1., 1.1, 2., 3. }, { 0., 20., 15., 40., 40., 5. }) };
  }

  std::vector<double> bounds(const Drive &drive)
  {
    std::vector<double> result = { 0. };
    result.insert(result.end(), drive.kinks().begin(), drive.kinks().end());
    result.push_back(drive.duration());
    return result;
  }

  Drive rise_rest_fall()
  {
    return Drive({ 0., 1., 2., 3., 4., 5. }, { 0., 20., 20., 30., 30., 5. });
  }
} // namespace

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

TEST(Drive, StepIsHalvedUntilTheSpeedChangesByNoMoreThanWasAskedFor)
{
  const Drive drive(DriveProfile::harmonic, 0., 65., 112., 1.);
  for (const double time : { 0., 0.1, 0.3, 0.7 })
  {
    const auto from   = drive.at(time, Drive::Side::after);
    const auto to     = drive.step(time, 8., 0.02);
    const auto change = [&](const DrivePoint &point) { return std::abs(point.v - from.v) / drive.peak_speed(); };
    const double dx   = std::abs(to.x - from.x);
    EXPECT_NEAR(std::log2(8. / dx), std::round(std::log2(8. / dx)), 1e-6) << time;
    EXPECT_LE(change(to), 0.02) << time;
    EXPECT_GT(change(drive.step(time, 2. * dx)), 0.02) << time;
  }
  const Drive triangle(DriveProfile::triangle, 0., 65., 112., 1.);
  EXPECT_EQ(triangle.step(0.1, 8., 0.02).time, triangle.step(0.1, 8.).time);
}

TEST(Drive, SliverBeforeAReversalIsTakenAlong)
{
  const Drive drive(DriveProfile::triangle, 0., 10.0005, 100., 1.);
  EXPECT_EQ(walk(drive, 1.).size(), 21u);
  EXPECT_EQ(walk(Drive(DriveProfile::triangle, 0., 10.01, 100., 1.), 1.).size(), 23u);
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

TEST(Drive, DirectionIsThatOfTheStrokeWhateverTheTurn)
{
  const Drive drive(DriveProfile::harmonic, 45., 65., 112., 6.5);
  int way = 1;
  EXPECT_EQ(drive.at(0., Drive::Side::after).v, 0.);
  EXPECT_EQ(drive_direction(drive.at(0., Drive::Side::after).v), 1);
  EXPECT_EQ(drive.reversals().size(), 12u);
  for (const double turn : drive.reversals())
  {
    EXPECT_EQ(drive.at(turn, Drive::Side::before).v, 0.);
    EXPECT_EQ(drive_direction(drive.at(turn, Drive::Side::before).v), way) << turn;
    EXPECT_EQ(drive_direction(drive.at(turn, Drive::Side::after).v), -way) << turn;
    way = -way;
  }
  EXPECT_EQ(drive_direction(drive.at(drive.duration()).v), 1);
}

TEST(Drive, RestKeepsTheDirectionThatLedToIt)
{
  const Drive drive({ 0., 1., 2., 3., 4., 5., 6. }, { 40., 40., 20., 20., 30., 30., 10. });
  EXPECT_EQ(drive_direction(drive.at(0.5).v), 1);
  EXPECT_EQ(drive_direction(drive.at(2.5).v), -1);
  EXPECT_EQ(drive_direction(drive.at(4.5).v), 1);
  // A rest at the beginning was reached forward.
  EXPECT_EQ(drive.reversals(), (std::vector<double>{ 1., 3., 5. }));
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

// 40 rows a period of a harmonic motion of up to 157 mm/s: five-point slopes are off by (omega h)^4/30, 2e-5, and no row or rest
// is overshot where others step.
TEST(Drive, TableHasTheSpeedOfASmoothMotionAndOvershootsNoStep)
{
  const double omega = 2. * M_PI / 0.4;
  std::vector<double> times, smooth, steps;
  for (unsigned int i = 0; i <= 80; ++i)
  {
    times.push_back(0.01 * i);
    smooth.push_back(55. - 10. * std::cos(omega * times.back()));
    steps.push_back(40. + 5. * (i / 10) + (i % 10 > 7 ? 1.7 * (i % 10 - 7) : 0.));
  }
  const Drive harmonic(times, smooth), staircase(times, steps);
  for (double time = 0.02; time < 0.78; time += 3.7e-4)
  {
    EXPECT_NEAR(harmonic.at(time).v, 10. * omega * std::sin(omega * time), 0.02) << time;
    const auto row = static_cast<std::size_t>(time / 0.01);
    EXPECT_GE(staircase.at(time).x, std::min(steps[row], steps[row + 1]) - 1e-12) << time;
    EXPECT_LE(staircase.at(time).x, std::max(steps[row], steps[row + 1]) + 1e-12) << time;
  }
}

// The turn of a harmonic motion at a share of the way from one of 46 rows a period to the next. Cubics through rows 0.14 rad
// apart have the turn within a thousandth of that, x there within 1e-5 of the amplitude, speeds within 1e-3 of the largest.
TEST(Drive, TableTurnsWhereAMotionDoesBetweenItsRows)
{
  const double omega = 2. * pi / 1.15, row = 0.025;
  for (const double share : { 0., 0.05, 0.3, 0.5, 0.8, 0.97 })
  {
    const double turn = 20. * row + share * row;
    std::vector<double> times, positions;
    for (unsigned int i = 0; i <= 40; ++i)
    {
      times.push_back(row * i);
      positions.push_back(40. + 25. * std::cos(omega * (times.back() - turn)));
    }
    const Drive drive(times, positions);
    ASSERT_EQ(drive.reversals().size(), 1u) << share;
    EXPECT_NEAR(drive.reversals()[0], turn, 1e-3 * row) << share;
    EXPECT_NEAR(drive.maximum(), 65., 25e-5) << share;
    EXPECT_TRUE(std::is_sorted(drive.kinks().begin(), drive.kinks().end(), std::less_equal<>())) << share;
    expect_walk_keeps_its_promises(drive, 1.);
    for (double time = 0.1; time < 0.9; time += 1.7e-4)
      EXPECT_NEAR(drive.at(time).v, -25. * omega * std::sin(omega * (time - turn)), 1e-3 * 25. * omega) << share;
  }
}

// Rows of 10 mm/s up and down, between whose corner and rests nothing is known: no turn is made up.
TEST(Drive, TableWithCornersOvershootsNone)
{
  const std::vector<double> even                                     = { 0., 1., 2., 3., 4., 5., 6., 7. };
  const std::pair<std::vector<double>, std::vector<double>> tables[] = {
    { even, { 0., 10., 20., 30., 34., 28., 18., 8. } },
    { even, { 0., 10., 20., 30., 30., 20., 10., 0. } },
    { even, { 0., 10., 20., 30., 20., 10., 0., -10. } },
    { { 0., 1., 2., 3., 4., 14., 15., 16., 17. }, { 0., 20., 36., 44., 46., 46., 40., 25., 5. } }, // a rest of two rows
    { { 0., 0.03, 0.14, 1.13, 1.22, 1.27 }, { 30.95, 36.53, 43.64, 42.27, 31.58, 18.62 } }
  };
  for (const auto &[times, rows] : tables)
  {
    const Drive drive(times, rows);
    double most = 0.;
    for (double time = 0.; time < times.back(); time += 1e-3)
      most = std::max(most, drive.at(time).x);
    EXPECT_NEAR(most, *std::max_element(rows.begin(), rows.end()), 1e-4);
    for (const double turn : drive.reversals())
      EXPECT_NE(std::find(times.begin(), times.end(), turn), times.end()) << turn;
  }
}

TEST(Drive, TableThatIsNoneIsRefused)
{
  EXPECT_THROW(Drive({ 0., 1., 2. }, { 0., 1., 2. }), InputError);
  EXPECT_THROW(Drive({ 1., 2., 3., 4. }, { 0., 1., 2., 3. }), InputError);
  EXPECT_THROW(Drive({ 0., 2., 2., 4. }, { 0., 1., 2., 3. }), InputError);
  EXPECT_THROW(Drive({ 0., 1., 2., 4. }, { 1., 1., 1., 1. }), InputError);
}

TEST(SmoothDrive, TurnsExactlyAndEndsAtFullSpeed)
{
  for (const double start : { 0., 20. })
    for (const double cycles : { 0.5, 1., 1.5, 2., 7. })
      for (const double duration : { 1e-6, 5e-3, 0.3 })
      {
        const Drive drive = smooth(start, cycles, duration);
        EXPECT_EQ(drive.reversal_duration(), duration);
        EXPECT_EQ(drive.reversals().size(), std::lround(2. * cycles) - 1);
        for (std::size_t i = 0; i < drive.reversals().size(); ++i)
        {
          const auto turn = drive.at(drive.reversals()[i]);
          EXPECT_EQ(turn.x, i % 2 == 0 ? 65. : start);
          EXPECT_EQ(turn.v, 0.);
        }
        const auto end = drive.at(drive.duration());
        EXPECT_EQ(end.x, std::lround(2. * cycles) % 2 == 1 ? 65. : start);
        EXPECT_EQ(std::abs(end.v), 112.);
        EXPECT_EQ(drive.at(0.).x, start);
        EXPECT_EQ(drive.at(0.).v, start == 0. ? 0. : 112.);
        EXPECT_EQ(drive.minimum(), start);
        EXPECT_EQ(drive.maximum(), 65.);
        EXPECT_EQ(drive.peak_speed(), 112.);
      }
}

TEST(SmoothDrive, RampsHaveTheirLength)
{
  const double T    = 5e-3;
  const Drive drive = smooth(0., 1., T);
  ASSERT_EQ(drive.kinks().size(), 4u);
  const auto ramped = drive.at(drive.kinks()[0]), braking = drive.at(drive.kinks()[1]), turned = drive.at(drive.kinks()[3]);
  EXPECT_DOUBLE_EQ(ramped.time, T);
  EXPECT_NEAR(ramped.x, 112. * T / 2., 1e-13);
  EXPECT_EQ(drive.kinks()[2], drive.reversals()[0]);
  EXPECT_NEAR(turned.time - braking.time, T, 1e-15);
  EXPECT_NEAR(65. - braking.x, 0.34375 * 112. * T, 1e-12);
  EXPECT_NEAR(65. - turned.x, 0.34375 * 112. * T, 1e-12);
  EXPECT_NEAR(drive.duration(), 130. / 112. + (0.5 + 1. - 2. * 0.34375) * T, 1e-14);
}

TEST(SmoothDrive, SpeedOfAReversalIsTheQuintic)
{
  const double T     = 5e-3;
  const Drive drive  = smooth(20., 1., T);
  const double begin = drive.kinks()[0];
  for (double tau = 0.; tau < 1.; tau += 0.01)
  {
    const double S = tau * tau * tau * (10. - 15. * tau + 6. * tau * tau);
    EXPECT_NEAR(drive.at(begin + tau * T).v, 112. * (1. - 2. * S), 1e-10);
  }
}

TEST(Drive, PositionIsTheIntegralOfVelocityAndVelocityThatOfAcceleration)
{
  for (const Drive &drive : all_drives())
  {
    const auto ends = bounds(drive);
    for (std::size_t i = 0; i + 1 < ends.size(); ++i)
    {
      EXPECT_LT(ends[i], ends[i + 1]);
      const unsigned int n = 2000;
      const double length  = (ends[i + 1] - ends[i]) / n;
      double way = 0., change = 0.;
      for (unsigned int j = 0; j < n; ++j)
        for (const double node : { -1., 1. })
        {
          const auto point = drive.at(ends[i] + (j + 0.5 + node / std::sqrt(12.)) * length);
          way += point.v * length / 2.;
          change += point.a * length / 2.;
        }
      const auto begin = drive.at(ends[i], Drive::Side::after), end = drive.at(ends[i + 1], Drive::Side::before);
      EXPECT_NEAR(way, end.x - begin.x, 1e-10);
      EXPECT_NEAR(change, end.v - begin.v, 1e-8);
    }
  }
}

TEST(SmoothDrive, LongestReversalsFillTheStrokes)
{
  const auto largest = [](const double start, const double cycles)
  { return Drive::largest_reversal_duration(start, 65., 112., cycles); };
  EXPECT_DOUBLE_EQ(largest(0., 1.), 65. / 112. / 0.84375);
  EXPECT_DOUBLE_EQ(largest(0., 0.5), 65. / 112. / 0.5);
  EXPECT_DOUBLE_EQ(largest(20., 1.), 45. / 112. / 0.34375);
  EXPECT_DOUBLE_EQ(largest(20., 1.5), 45. / 112. / 0.6875);
  EXPECT_DOUBLE_EQ(largest(0., 1.125), 65. / 4. / 112. / 0.34375);
  EXPECT_EQ(largest(20., 0.5), std::numeric_limits<double>::infinity());
  for (const double cycles : { 0.25, 0.5, 0.8, 1., 1.5, 2., 2.1 })
  {
    const Drive drive = smooth(0., cycles, largest(0., cycles));
    expect_walk_keeps_its_promises(drive, 1.);
    const auto ends = bounds(drive);
    for (std::size_t i = 0; i + 1 < ends.size(); ++i)
      EXPECT_GT(ends[i + 1] - ends[i], 1e-3);
    EXPECT_NEAR(std::abs(drive.at(drive.duration()).v), 112., 1e-9);
  }
}
