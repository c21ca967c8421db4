// SPDX-License-Identifier: GPL-3.0-only
#include "analytic/closed_form.h"

#include "results/row_statistics.h"
#include "scene/closed_form.h"
#include "scene/scene.h"
#include "scenes.h"
#include "support/work_of_drive.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

using namespace sprag;

namespace
{
  std::vector<Row> compute_rows(const Scene &scene)
  {
    std::vector<Row> rows;
    run_closed_form(scene, [&](const Row &row) { rows.push_back(row); });
    return rows;
  }

  Scene driven(Scene scene, const Drive &drive)
  {
    scene.drive = drive;
    return scene;
  }

  std::vector<Scene> scenes()
  {
    const Drive twice(DriveProfile::triangle, 0., 65., 112., 2.);
    const Drive smooth(DriveProfile::harmonic, 0., 65., 112., 1.);
    const Drive table({ 0., 0.2, 0.5, 0.9, 1.1, 1.5, 2. }, { 0., 30., 60., 60., 20., 50., 0. });
    return { model_a(), model_b(), driven(model_a(), twice), driven(model_a(), smooth), driven(model_b(), table) };
  }

  Scene make_pair_scene(Scene scene, const SpringJoint joint, const double offset)
  {
    scene.pair.type            = PairType::full;
    scene.pair.joint           = joint;
    scene.pair.cylinder_offset = offset;
    return scene;
  }

  /// Indices of the rows that repeat the instant of the row before them.
  std::vector<std::size_t> second_rows(const std::vector<Row> &rows)
  {
    std::vector<std::size_t> result;
    for (std::size_t i = 1; i < rows.size(); ++i)
      if (rows[i][Column::time] == rows[i - 1][Column::time])
        result.push_back(i);
    return result;
  }
} // namespace

TEST(ClosedFormRows, EveryReversalHasARowBeforeAndOneAfterIt)
{
  for (const Scene &scene : scenes())
  {
    const auto rows    = compute_rows(scene);
    const auto seconds = second_rows(rows);
    ASSERT_EQ(seconds.size(), scene.drive.reversals().size());
    for (std::size_t i = 0; i < seconds.size(); ++i)
    {
      const Row &before = rows[seconds[i] - 1];
      const Row &after  = rows[seconds[i]];
      EXPECT_EQ(after[Column::time], scene.drive.reversals()[i]);
      EXPECT_EQ(after[Column::x], before[Column::x]);
      EXPECT_EQ(after[Column::theta], before[Column::theta]);
      EXPECT_EQ(after[Column::v], -before[Column::v]);
      EXPECT_EQ(after[Column::step], 0.);
      for (const auto work : { Column::drive_work, Column::friction_work, Column::spring_energy })
        EXPECT_EQ(after[work], before[work]);
      // At x = 0 both are 0.
      EXPECT_EQ(before[Column::F] * after[Column::F]<0., before[Column::x]> 0.);
    }
  }
}

// P of eq. 5 with mu of an exponential: largest where a harmonic drive is nearly at rest and friction rises within half a
// millimetre. Rows 1 mm apart missed it by 0.45 %.
TEST(ClosedFormRows, FollowFrictionWhereAHarmonicDriveTurns)
{
  Scene scene        = driven(model_a(), Drive(DriveProfile::harmonic, 0., 65., 112., 0.5));
  scene.friction.law = StribeckFriction{ 0.9, 0.6, 30., 1., 0. };
  const auto &g      = scene.geometry;
  const auto theta = [&](const double x) { return std::asin((g.cylinder_radius - g.interface_offset) / (g.pivot_distance - x)); };
  double expected  = 0.;
  for (double phase = 0.; phase < M_PI; phase += 1e-4)
  {
    const double x = 32.5 * (1. - std::cos(phase)), v = 112. * std::sin(phase);
    const double s  = (g.pivot_distance - x) * std::cos(theta(x));
    const double w  = v * std::cos(theta(x)) - g.interface_offset * std::sin(theta(x)) / s * v;
    const double mu = 0.6 + 0.3 * std::exp(-w / 30.);
    expected        = std::max(expected, scene.spring.stiffness * (theta(x) - theta(0.)) / (s + mu * g.interface_offset));
  }
  EXPECT_NEAR(largest(compute_rows(scene), Column::P), expected, 2e-4 * expected);
}

TEST(ClosedFormRows, EnergyBalancesInEveryRow)
{
  for (const Scene &scene : scenes())
  {
    const auto rows = compute_rows(scene);
    const double E0 = rows.front()[Column::spring_energy];
    for (const Row &row : rows)
      EXPECT_NEAR(row[Column::drive_work], row[Column::friction_work] + row[Column::spring_energy] - E0,
                  1e-10 * std::max(1., rows.back()[Column::friction_work]));
  }
}

TEST(ClosedFormRows, LoopAreaOfTheRowsEqualsFrictionWork)
{
  for (Scene scene : scenes())
  {
    // The trapezoidal rule over x knows nothing of how the works were integrated. It errs by step^2/12 times the change of
    // dQ/dx on a stroke: 1e-5 mm^2 x less than 1 N/mm for each of up to four strokes, and more where a smooth drive starts
    // or stops, since mu(v) then changes as the root of the distance: step^1.5 x 20 N/mm^0.5 = 6e-3 N mm.
    scene.analysis.step = 0.01;
    const auto rows     = compute_rows(scene);
    double area         = 0.;
    for (std::size_t i = 1; i < rows.size(); ++i)
      area += 0.5 * (rows[i - 1][Column::Q] + rows[i][Column::Q]) * (rows[i][Column::x] - rows[i - 1][Column::x]);
    const bool smooth = scene.drive.profile() != DriveProfile::triangle;
    EXPECT_NEAR(area, rows.back()[Column::friction_work], smooth ? 3e-2 : 1e-4);
    // Tables are integrated in few pieces.
    const double alike = scene.drive.profile() == DriveProfile::table ? 1e-7 : 1e-9;
    EXPECT_NEAR(rows.back()[Column::drive_work], loop_area(scene), alike * area);
    EXPECT_NEAR(rows.back()[Column::friction_work], friction_work(scene), alike * area);
  }
}

TEST(ClosedFormRows, APairWithoutOffsetIsASingleLeverTwice)
{
  const auto single = compute_rows(model_a());
  for (const auto joint : { SpringJoint::held, SpringJoint::free })
  {
    const auto rows = compute_rows(make_pair_scene(model_a(), joint, 0.));
    ASSERT_EQ(rows.size(), single.size());
    for (std::size_t i = 0; i < rows.size(); ++i)
    {
      for (const auto column : { Column::theta, Column::s, Column::P, Column::F, Column::Q, Column::v_rel, Column::mu })
        EXPECT_EQ(rows[i][column], single[i][column]);
      for (const auto column : { Column::drive_work, Column::friction_work, Column::spring_energy, Column::friction_power })
        EXPECT_EQ(rows[i][column], 2. * single[i][column]);
      EXPECT_EQ(rows[i].drive_force(), 2. * single[i][Column::Q]);
      EXPECT_EQ(rows[i].friction_force(), 2. * single[i][Column::F]);
      EXPECT_EQ(rows[i].lateral_force(), 0.);
      EXPECT_EQ(rows[i].swing(), 0.);
    }
  }
}

TEST(ClosedFormRows, BothLeversOfAPairShareTheDrivesWorkAndItsEnergy)
{
  for (const auto &[joint, offset] : { std::pair{ SpringJoint::held, 0.5 }, std::pair{ SpringJoint::free, -0.5 } })
  {
    Scene scene          = make_pair_scene(model_a(), joint, offset);
    scene.analysis.step  = 0.01;
    const auto rows      = compute_rows(scene);
    const double started = rows.front()[Column::spring_energy];
    const double total   = rows.back()[Column::friction_work];
    double area          = 0.;
    for (std::size_t i = 0; i < rows.size(); ++i)
    {
      const double stored = rows[i][Column::spring_energy] - started;
      EXPECT_NEAR(rows[i][Column::drive_work], rows[i][Column::friction_work] + stored, 1e-8 * total);
      EXPECT_FALSE(std::isnan(rows[i][Column::friction_power]));
      if (i > 0)
        area += 0.5 * (rows[i - 1].drive_force() + rows[i].drive_force()) * (rows[i][Column::x] - rows[i - 1][Column::x]);
    }
    // The trapezoidal rule as above; where a lever begins to be reached dQ/dx jumps by 0.1 N/mm.
    EXPECT_NEAR(area, total, 2e-4);
  }
}
