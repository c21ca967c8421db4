// SPDX-License-Identifier: GPL-3.0-only
#include "analysis/statics/quasi_static.h"

#include "analysis/toy_model.h"
#include "scene/scene.h"
#include "support/thrown.h"
#include "verification/run_scene.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <string>

using namespace sprag;

namespace
{
  QuasiStaticSettings make_settings(const double step)
  {
    QuasiStaticSettings settings;
    settings.step         = step;
    settings.minimum_step = 1e-3;
    return settings;
  }

  const Drive one_way(DriveProfile::triangle, 0., 20., 1., 0.5);

  std::vector<Row> run(ToyModel &model, const Drive &drive, const QuasiStaticSettings &settings)
  {
    std::vector<Row> rows;
    run_quasi_static(model, drive, settings, [&](const State &, const Row &row, const Evaluation &) { rows.push_back(row); });
    return rows;
  }

  /// Steps across the middle of the stroke succeed only if they are short.
  bool fails_if_long_near_the_middle(const double from, const double to)
  {
    return to > 10. && from < 11. && to - from > 0.1;
  }
} // namespace

TEST(QuasiStatic, CutsStepsBackWhereTheyFailAndLetsThemGrowAgain)
{
  ToyModel model;
  model.fails     = fails_if_long_near_the_middle;
  const auto rows = run(model, one_way, make_settings(1.));
  EXPECT_EQ(rows.front()[Column::x], 0.);
  EXPECT_EQ(rows.back()[Column::x], 20.);
  double shortest = 1.;
  for (std::size_t i = 1; i < rows.size(); ++i)
  {
    const double step = rows[i][Column::x] - rows[i - 1][Column::x];
    EXPECT_FALSE(fails_if_long_near_the_middle(rows[i - 1][Column::x], rows[i][Column::x]));
    EXPECT_NEAR(rows[i][Column::step], step, 1e-12);
    EXPECT_LE(step, 1.001); // a sliver at the end is taken along
    EXPECT_NEAR(rows[i][Column::Q], rows[i][Column::x], 1e-12);
    shortest = std::min(shortest, step);
  }
  EXPECT_LE(shortest, 0.1);
  EXPECT_GE(shortest, 0.01);
  EXPECT_NEAR(rows[5][Column::step], 1., 1e-12);
  EXPECT_NEAR(rows[rows.size() - 2][Column::step], 1., 1e-12);
}

TEST(QuasiStatic, RejectedStepsLeaveNoTraceInTheHistory)
{
  ToyModel model;
  model.fails     = fails_if_long_near_the_middle;
  const auto rows = run(model, one_way, make_settings(1.));
  EXPECT_TRUE(model.history_intact);
  EXPECT_EQ(rows.back()[Column::x], 20.);
}

TEST(QuasiStatic, BalancedStatesThatTheModelObjectsToAreRejected)
{
  ToyModel model;
  model.objects = [](const double x) { return x > 15. ? "worn out" : ""; };
  std::vector<Row> rows;
  const auto text = thrown_text<AnalysisError>(
      [&]
      {
        run_quasi_static(model, one_way, make_settings(1.),
                         [&](const State &, const Row &row, const Evaluation &) { rows.push_back(row); });
      });
  EXPECT_NE(text.find("worn out"), std::string::npos) << text;
  EXPECT_LE(rows.back()[Column::x], 15.);
  EXPECT_GT(rows.back()[Column::x], 15. - 4. * 1e-3); // within the last step tried
}

TEST(QuasiStatic, GivesUpNamingThePlaceAndKeepsWhatIsDone)
{
  ToyModel model;
  model.fails = [](double, const double to) { return to > 12.25; };
  std::vector<Row> rows;
  std::vector<double> accepted;
  std::string message;
  try
  {
    run_quasi_static(model, one_way, make_settings(1.),
                     [&](const State &state, const Row &row, const Evaluation &)
                     {
                       rows.push_back(row);
                       accepted.push_back(state.coordinates[0]);
                     });
  }
  catch (const AnalysisError &error)
  {
    message = error.what();
  }
  ASSERT_FALSE(rows.empty());
  EXPECT_LE(rows.back()[Column::x], 12.25);
  EXPECT_GT(rows.back()[Column::x], 12.25 - 4. * 1e-3);
  EXPECT_NE(message.find("x = 12.2"), std::string::npos) << message;
  EXPECT_NE(message.find("no solution here"), std::string::npos) << message;
  for (std::size_t i = 0; i < rows.size(); ++i)
    EXPECT_NEAR(accepted[i], rows[i][Column::x], 1e-12);
}

TEST(QuasiStatic, WorkOfTheDriveIsTheIntegralOfQ)
{
  ToyModel model;
  const Drive there_and_back(DriveProfile::triangle, 0., 20., 1., 1.);
  const auto rows = run(model, there_and_back, make_settings(1.));
  const auto turn = std::find_if(rows.begin(), rows.end(), [](const Row &row) { return row[Column::x] == 20.; });
  // Q = x: the trapezoidal rule is exact.
  ASSERT_NE(turn, rows.end());
  EXPECT_NEAR((*turn)[Column::drive_work], 200., 1e-10);
  EXPECT_NEAR(rows.back()[Column::drive_work], 0., 1e-10);
}
