// SPDX-License-Identifier: GPL-3.0-only
#include "report/report.h"
#include "report/console_summary.h"
#include "report/summary_lines.h"

#include "run/vibration_report.h"
#include "scene/closed_form.h"
#include "scene/scene.h"
#include "scenes.h"
#include "support/find_value.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <sstream>

using namespace sprag;

namespace
{
  /// Rows of the closed form, but for the first millimetre behind a turn: there Q goes linearly from its value before the turn to
  /// that of the closed form, as in stick.
  std::vector<Row> rows_with_stick(const Scene &scene, const double step)
  {
    std::vector<Row> rows;
    double turned_at = -100.;
    double before    = 0.;
    for (DrivePoint point = scene.drive.at(0., Drive::Side::after);; point = scene.drive.step(point.time, step))
    {
      const auto slide    = closed_form(scene, point.x, point.v);
      const double travel = std::abs(point.x - turned_at);
      Row row;
      row[Column::time]               = point.time;
      row[Column::x]                  = point.x;
      row[Column::v]                  = point.v;
      row[Column::P]                  = slide.P;
      row[Column::Q]                  = travel < 1. ? before + travel * (slide.Q - before) : slide.Q;
      row[Column::F]                  = row[Column::Q];
      row[Column::mu]                 = slide.mu;
      row[Column::theta]              = slide.contact.theta;
      row[Column::friction_resultant] = row[Column::F];
      for (const auto column : { Column::drive_work, Column::friction_work, Column::spring_energy, Column::elastic_energy })
        row[column] = 0.;
      add_closed_form(scene, row);
      rows.push_back(row);
      const auto &turns = scene.drive.reversals();
      if (std::binary_search(turns.begin(), turns.end(), point.time))
      {
        turned_at = point.x;
        before    = row[Column::Q];
      }
      if (point.time >= scene.drive.duration())
        return rows;
    }
  }

  Scene moved_by(const Drive &drive)
  {
    Scene scene = model_a();
    scene.drive = drive;
    return scene;
  }
} // namespace

// The second lever's friction has turned in the first row behind the reversal, where its P is largest, the first one's has not.
TEST(Report, PeaksOfThePairsSecondLeverCountByItsOwnFriction)
{
  std::vector<Row> rows;
  for (const auto &[x, friction, P] :
       { std::array{ 65., 9., 18. }, { 64.9, 2., 21.5 }, { 64.8, -10., 21.4 }, { 64., -10., 21. } })
  {
    Row row, second;
    row[Column::time] = 65. - x;
    row[Column::x]    = x;
    row[Column::v]    = x < 65. ? -112. : 112.;
    for (Row *const lever : { &row, &second })
    {
      (*lever)[Column::normal_resultant]   = 20.;
      (*lever)[Column::mu]                 = lever == &row ? 0.5 : 0.25;
      (*lever)[Column::friction_resultant] = friction;
      (*lever)[Column::P]                  = P;
    }
    second[Column::friction_resultant] = x < 65. ? -5. : 5.;
    row.add_second_lever(second);
    rows.push_back(row);
  }
  std::vector<Entry> entries;
  add_pair(rows, entries);
  EXPECT_EQ(find_value(entries, "second_peak_P_backward"), 21.5);
}

// s = mu e = 120.84 mm at l - x = sqrt(s^2 + (R - e)^2): a rigid lever locks with mu = 2.65 from x = 64.21 mm on.
TEST(Report, StickPastLockingHasItsEnds)
{
  Scene scene        = model_a();
  scene.friction.law = CoulombFriction{ 2.65 };
  const auto summary = [&](const double slides_at)
  {
    std::vector<Row> rows;
    for (const double x : { 65., 64.9, 64.3, 64.1, 63.7, 63. })
    {
      Row row;
      row[Column::x]                  = x;
      row[Column::v]                  = -112.;
      row[Column::P]                  = 500.;
      row[Column::mu]                 = 2.65;
      row[Column::normal_resultant]   = 500.;
      row[Column::friction_resultant] = x > slides_at ? -1200. : -2.65 * 500.;
      add_closed_form(scene, row);
      rows.push_back(row);
    }
    return make_summary(scene, rows);
  };
  const auto passed = summary(63.8);
  EXPECT_EQ(find_value(passed, "stick_past_locking_begin"), 65.);
  EXPECT_EQ(find_value(passed, "stick_past_locking_end"), 63.7);
  EXPECT_EQ(find_value(summary(64.2), "stick_past_locking_end"), 64.1);
  scene.friction.law = CoulombFriction{ 2.6 };
  EXPECT_THROW(find_value(summary(63.8), "stick_past_locking_end"), std::out_of_range);
}

// A table's speed is 0 at its turns, and a row stands there.
TEST(Report, StickAfterTheTurnsOfATableIsNoDeviation)
{
  const Drive unequal({ 0., 0.3, 0.6, 0.8, 1.2, 1.4, 2. }, { 0., 30., 60., 20., 50., 5., 0. });
  const Drive rests({ 0., 0.2, 0.5, 0.9, 1.1, 1.5, 2. }, { 0., 30., 60., 60., 20., 50., 0. });
  const Drive harmonic(DriveProfile::harmonic, 20., 65., 112., 2.);
  for (const Drive &drive : { unequal, rests, harmonic })
  {
    const Scene scene  = moved_by(drive);
    const auto rows    = rows_with_stick(scene, 0.25);
    const auto summary = make_summary(scene, rows);
    for (const std::string way : { "forward", "backward" })
    {
      EXPECT_NEAR(find_value(summary, "deviation_Q_" + way), 0., 1e-12);
      EXPECT_NEAR(find_value(summary, "deviation_P_" + way), 0., 1e-12);
    }
  }
}

// The forces of the second lever are 1.25 times those of the first.
TEST(Report, TellsTheLargestForcesOfASecondLever)
{
  const Scene scene  = moved_by(Drive(DriveProfile::harmonic, 20., 65., 112., 1.));
  auto rows          = rows_with_stick(scene, 0.25);
  const auto summary = make_summary(scene, rows);
  for (Row &row : rows)
  {
    Row second = row;
    for (const Column column : { Column::P, Column::Q })
      second[column] *= 1.25;
    row.add_second_lever(second);
  }
  std::vector<Entry> pair;
  add_pair(rows, pair);
  for (const std::string name : { "peak_P_forward", "peak_P_backward", "peak_Q_forward", "peak_Q_backward" })
    EXPECT_NEAR(find_value(pair, "second_" + name), 1.25 * find_value(summary, name), 1e-9) << name;
}

TEST(Report, SlopeIsToldWhereMuStaysAlone)
{
  const auto slope = [](const Drive &drive, const std::string &way)
  {
    const Scene scene = moved_by(drive);
    return find_value(make_summary(scene, rows_with_stick(scene, 0.25)), "slope_" + way);
  };
  // Turns within the 10 mm of the fit, behind which friction is not yet that of sliding.
  const Drive triangle(DriveProfile::triangle, 4., 65., 112., 2.);
  for (const auto &[way, sign] : { std::pair<std::string, int>{ "forward", 1 }, { "backward", -1 } })
  {
    const double mu       = closed_form(model_a(), 0., 112.).mu;
    const double expected = representative_slope(model_a().geometry, model_a().spring.stiffness, mu, sign);
    EXPECT_NEAR(slope(triangle, way), expected, 0.01 * std::abs(expected));
    EXPECT_TRUE(std::isnan(slope(Drive(DriveProfile::harmonic, 0., 65., 112., 1.), way)));
  }
}

// The largest force of a stroke that comes to rest is in the row of its turning point.
TEST(Report, TurningPointBelongsToTheStrokeThatEndsThere)
{
  const Scene scene  = moved_by(Drive(DriveProfile::harmonic, 0., 65., 112., 1.));
  const auto rows    = rows_with_stick(scene, 1.);
  const auto summary = make_summary(scene, rows);
  EXPECT_DOUBLE_EQ(find_value(summary, "peak_P_forward"), closed_form(scene, 65., 0.).P);
}

// A sine of 5 N by rows 0.3 rad apart, the largest of which is up to 0.06 N short of its peak.
TEST(Report, PeaksInTimeLieBetweenRows)
{
  std::vector<Row> rows;
  for (unsigned int i = 0; i < 60; ++i)
  {
    Row row;
    row[Column::time]           = 1e-3 * i;
    row[Column::x]              = 0.112 * i;
    row[Column::v]              = 112.;
    row[Column::kinetic_energy] = 0.;
    row[Column::P]              = 20. + 5. * std::sin(0.31 * i + 0.13);
    row[Column::Q]              = row[Column::P];
    rows.push_back(row);
  }
  const auto largest_row =
      std::max_element(rows.begin(), rows.end(), [](const Row &a, const Row &b) { return a[Column::P] < b[Column::P]; });
  const auto summary = transient_summary(model_a(), rows);
  EXPECT_NEAR(find_value(summary, "peak_P_forward"), 25., 2e-3);
  EXPECT_GT(find_value(summary, "peak_P_forward"), (*largest_row)[Column::P]);
  const auto is_backward = [](const Entry &entry) { return entry.name == "peak_P_backward"; };
  EXPECT_EQ(std::count_if(summary.begin(), summary.end(), is_backward), 0); // it moves forward alone
}

// A force that rises slowly and falls at once, as before a sudden reversal: a parabola would rise to 250 kN.
TEST(Report, ASuddenFallLeavesThePeakAtItsRow)
{
  std::vector<Row> rows;
  for (const auto &[time, P] : { std::pair{ 0., 12.8 }, { 1e-3, 12.9 }, { 2e-3, 13. }, { 2e-3 + 1e-9, 12. }, { 3e-3, 11. } })
  {
    Row row;
    row[Column::time]           = time;
    row[Column::v]              = 112.;
    row[Column::kinetic_energy] = 0.;
    row[Column::P]              = P;
    rows.push_back(row);
  }
  EXPECT_EQ(find_value(transient_summary(model_a(), rows), "peak_P_forward"), 13.);
}

TEST(SummaryTable, PrintsEntriesOfALineTogetherAndNothingThatDoesNotApply)
{
  const double unknown = std::nan("");
  std::ostringstream printed;
  print_console_summary(printed,
                        answer_lines(AnalysisType::transient, { { "peak_Q_forward", 18. },
                                                                { "peak_Q_support_forward", 18. },
                                                                { "peak_Q_backward", -23.456 },
                                                                { "peak_Q_support_backward", -20. },
                                                                { "reversal_1_frequency", unknown },
                                                                { "reversal_1_overshoot_P", 0.24 },
                                                                { "reversal_13_x", 65. },
                                                                { "creep", 1. } }),
                        { { "P", "its peak", { { "step", 0.02, "Try less." } }, {} }, { "Q", "", {}, "No estimate." } }, 0.5,
                        0.7);
  EXPECT_EQ(printed.str(), "  largest Q             forward 18 N, backward -23.46 N\n"
                           "  on the ground         backward -20 N\n"
                           "  reversal 1.           overshoot of P 24 %\n"
                           "                        and 1 more in /summary\n"
                           "  errors, estimated     P 2 %\n"
                           "  not estimated         Q: No estimate.\n"
                           "  to improve the worst  Try less.\n"
                           "  cost                  0.5 s of CPU time, 0.7 s of wall time\n");
}

TEST(Report, LimitsOfStabilitySayOnWhichSideTheyAreStable)
{
  // Flutter for e from 15.69 to 24.28 mm at worst, from 20 mm with the scene's constants alone.
  CriticalSearch search{ { "Geometry/Interface offset", 0., 29., 13 }, SlideKind::stable, {}, {}, {}, {}, 2. };
  CriticalValue begin{ 15.691, SlideKind::stable, SlideKind::flutter, {}, unknown };
  begin.error = 0.123;
  begin.own   = 20.;
  CriticalValue end{ 24.279, SlideKind::flutter, SlideKind::stable, {}, unknown };
  end.own              = 24.1;
  search.changes       = { begin, end };
  const auto find_text = [&]
  {
    const auto entries = critical_entries(model_a(), { search });
    const auto found =
        std::find_if(entries.begin(), entries.end(),
                     [](const Entry &entry) { return entry.name == "critical_geometry_interface_offset_verdicts"; });
    return std::get<std::string>(found->value);
  };
  EXPECT_EQ(find_text(),
            "Geometry/Interface offset from 0 to 29 mm: stable, flutter from 15.69 +- 0.12 mm (stable up to 20 mm with the "
            "scene's constants), stable from 24.28 mm (stable from 24.1 mm with the scene's constants)");
  search.changes[0].own = end.value;
  search.changes[1].own = begin.value;
  EXPECT_NE(find_text().find("0.12 mm (no limit here with the scene's constants), stable from 24.28 mm (no limit here with"),
            std::string::npos)
      << find_text();
  search.changes        = { begin };
  search.changes[0].own = 29.;
  EXPECT_NE(find_text().find("flutter from 15.69 +- 0.12 mm (stable throughout with the scene's constants)"), std::string::npos);
  const auto entries = critical_entries(model_a(), { search });
  EXPECT_EQ(find_value(entries, "critical_geometry_interface_offset_1_error"), 0.123);
}
