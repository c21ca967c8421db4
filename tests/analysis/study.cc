// SPDX-License-Identifier: GPL-3.0-only
#include "analysis/study/study_points.h"
#include "analysis/study/study_results.h"
#include "analysis/task_farm/task_farm.h"

#include "scene/messages.h"
#include "scene/scene.h"

#include <cmath>
#include <limits>

using namespace sprag;

namespace
{
  constexpr double none = std::numeric_limits<double>::quiet_NaN();

  Entry number(const std::string &name, const double value)
  {
    return { name, value, "N mm", "a number" };
  }

  StudyRecord completed(const std::size_t run, const double work, const double loop_area)
  {
    StudyRecord record;
    record.run   = run;
    record.work  = work;
    record.found = { { number("loop_area", loop_area) }, {} };
    return record;
  }

  /// Forward P = x/2, Q = x; backward P = x/4, Q = -x.
  StrokeCurve there_and_back(const std::vector<double> &forward, const std::vector<double> &backward)
  {
    StrokeCurve curve;
    for (const double x : forward)
      curve.push_back({ x, 1., x / 2., x });
    for (const double x : backward)
      curve.push_back({ x, -1., x / 4., -x });
    return curve;
  }
} // namespace

TEST(Trade, OnTheFrontNobodyCheaperIsAsExact)
{
  const std::vector<double> costs  = { 1., 2., 3., 4., none, 3., 0.5 };
  const std::vector<double> errors = { 0.1, 0.2, 0.01, 0.01, 0., 0.01, none };
  EXPECT_EQ(pareto_front(costs, errors), (std::vector<bool>{ true, false, true, false, false, true, false }));
}

TEST(Trade, RecommendsTheCheapestThatIsExactEnough)
{
  const std::vector<double> costs  = { 1., 2., 3., 4., none };
  const std::vector<double> errors = { 0.1, 0.005, 0.004, none, 0. };
  EXPECT_EQ(cheapest_within(0.1, costs, errors), 0u);
  EXPECT_EQ(cheapest_within(0.01, costs, errors), 1u);
  EXPECT_EQ(cheapest_within(0.0045, costs, errors), 2u);
  EXPECT_FALSE(cheapest_within(0.001, costs, errors));
}

TEST(StrokeErrors, CompareAtTheSamePlacesOfTheSameStroke)
{
  const auto reference = there_and_back({ 0., 10., 20. }, { 19.9, 10., 0. });
  auto curve           = there_and_back({ 0., 4., 15., 20. }, { 15., 5., 0. });
  EXPECT_LT(stroke_errors(curve, reference).P, 1e-15);
  EXPECT_LT(stroke_errors(curve, reference).Q, 1e-15);
  curve[2].P += 0.1; // forward the peak of P is 10
  curve[5].P += 0.1; // backward 19.9/4
  curve[1].Q -= 0.2; // 20
  EXPECT_NEAR(stroke_errors(curve, reference).P, 0.1 / (19.9 / 4.), 1e-14);
  EXPECT_NEAR(stroke_errors(curve, reference).Q, 0.01, 1e-14);
}

TEST(StrokeErrors, LeaveOutWhatIsRightBehindAReversal)
{
  const auto reference = there_and_back({ 0., 20. }, { 20., 0. });
  auto curve           = there_and_back({ 0., 20. }, { 19.9, 19.8, 0. }); // a 130th of 20 mm is 0.154 mm
  curve[2].P += 5.;
  EXPECT_LT(stroke_errors(curve, reference).P, 1e-15);
  curve[3].P += 0.5;
  EXPECT_NEAR(stroke_errors(curve, reference).P, 0.1, 1e-14);
}

TEST(StrokeErrors, AreUnknownWhereStrokesDiffer)
{
  const auto reference = there_and_back({ 0., 20. }, { 19., 0. });
  EXPECT_TRUE(std::isnan(stroke_errors(there_and_back({ 0., 20. }, {}), reference).P));
  EXPECT_TRUE(std::isnan(stroke_errors({}, reference).Q));
}

TEST(Measures, AreThoseThatTheReferenceKnows)
{
  const Comparable reference = { { number("peak_P_forward", 10.), number("peak_P_backward", -20.), number("peak_Q_forward", 0.),
                                   number("reversal_1_frequency", none), number("reversal_2_frequency", 100.) },
                                 {} };
  const auto measures        = make_measures(AnalysisType::transient, reference);
  ASSERT_EQ(measures.size(), 2u);
  EXPECT_EQ(measures[0].name, "peak_P");
  EXPECT_EQ(measures[1].name, "frequency");
  const Comparable run = {
    { number("peak_P_forward", 10.1), number("peak_P_backward", -19.), number("reversal_1_frequency", 3.) }, {}
  };
  const auto errors = compute_errors(AnalysisType::transient, run, reference);
  EXPECT_NEAR(errors.at(0), 0.05, 1e-14);
  EXPECT_TRUE(std::isnan(errors.at(1))); // the run does not know it
}

// Face sizes 1, 2, 4 of degree 1 with errors 1, 4, 16 %, of degree 2 one is wrong by 0.05 %, one fails, one is not there yet.
TEST(StudyTrade, OfASmallTable)
{
  StudySettings settings;
  settings.varied           = { { "Mesh/Degree", { "1", "2" } }, { "Mesh/Face size", { "1", "2", "4" } } };
  settings.reference_values = { { "Mesh/Face size", { "0.1" } } };
  StudyRecords records      = { { 0, completed(0, 4., 101.) },   { 1, completed(1, 2., 104.) }, { 2, completed(2, 1., 84.) },
                                { 3, completed(3, 3., 100.05) }, { 4, completed(4, 0.1, 1.) },  { 6, completed(6, 60., 100.) } };
  records[4].outcome        = RunOutcome::failed;
  const auto trade          = compute_trade(settings, make_study_points(settings), records);
  ASSERT_EQ(trade.measured.size(), 1u);
  const auto &measured = trade.measured.front();
  EXPECT_EQ(measured.measure.name, "loop_area");
  const std::vector<double> expected = { 0.01, 0.04, 0.16, 0.0005 };
  for (std::size_t row = 0; row < expected.size(); ++row)
    EXPECT_NEAR(measured.errors[row], expected[row], 1e-14);
  EXPECT_TRUE(std::isnan(measured.errors[4]));
  EXPECT_EQ(measured.front, (std::vector<bool>{ false, true, true, true, false }));
  EXPECT_EQ(measured.recommended[0], 1u);
  EXPECT_EQ(measured.recommended[1], 3u);
  EXPECT_EQ(measured.recommended[2], 3u);
  EXPECT_FALSE(measured.recommended[3]);
  ASSERT_EQ(trade.orders.size(), 1u);
  EXPECT_NEAR(trade.orders.front().order, 2., 1e-12);
  EXPECT_EQ(trade.orders.front().others, "Mesh/Degree = 1");
}

// The coarsest run meets the reference by chance, and the second finest fails.
TEST(StudyTrade, RecommendsNoneThatIsExactByChance)
{
  StudySettings settings;
  settings.varied        = { { "Mesh/Face size", { "1", "2", "4", "8" } } };
  StudyRecords records   = { { 0, completed(0, 4., 100.01) },
                             { 1, completed(1, 2., 104.) },
                             { 2, completed(2, 1., 103.) },
                             { 3, completed(3, 0.5, 100.) },
                             { 4, completed(4, 60., 100.) } };
  const auto recommended = [&]
  { return compute_trade(settings, make_study_points(settings), records).measured.front().recommended; };
  EXPECT_EQ(recommended()[0], 3u);
  EXPECT_EQ(recommended()[1], 0u);
  EXPECT_EQ(recommended()[2], 0u);
  EXPECT_FALSE(recommended()[3]);
  records[1].outcome = RunOutcome::failed;
  EXPECT_EQ(recommended()[0], 0u);
}

TEST(StudyTrade, IsNoneWithoutAReferenceThatIsCompleted)
{
  StudySettings settings;
  settings.varied      = { { "Mesh/Face size", { "1", "2" } } };
  StudyRecords records = { { 0, completed(0, 4., 101.) }, { 2, completed(2, 60., 100.) } };
  EXPECT_FALSE(compute_trade(settings, make_study_points(settings), records).measured.empty());
  records[2].outcome = RunOutcome::failed;
  EXPECT_TRUE(compute_trade(settings, make_study_points(settings), records).measured.empty());
  records.erase(2);
  EXPECT_TRUE(compute_trade(settings, make_study_points(settings), records).measured.empty());
}
