// SPDX-License-Identifier: GPL-3.0-only
#include "results/row_statistics.h"

#include <gtest/gtest.h>
#include <limits>

using namespace sprag;

namespace
{
  std::vector<Row> make_rows(const std::vector<double> &values)
  {
    std::vector<Row> rows(values.size());
    for (std::size_t i = 0; i < values.size(); ++i)
      rows[i][Column::Q] = values[i];
    return rows;
  }

  const double no_number = std::numeric_limits<double>::quiet_NaN();
} // namespace

TEST(RowStatistics, PassOverWhatIsNoNumber)
{
  const auto rows = make_rows({ no_number, 2., -5., no_number, 3. });
  const auto Q    = [](const Row &row) { return row[Column::Q]; };
  EXPECT_EQ(signed_peak(rows, Q), -5.);
  EXPECT_EQ(largest(rows, Q), 5.);
  EXPECT_EQ(largest(rows, Column::Q), 5.);
  EXPECT_EQ(sum(rows, Column::Q), 0.);
  EXPECT_EQ(find_largest_row(rows, Q), &rows[4]);
}

TEST(RowStatistics, TakeARowOfAnInfiniteValueForNone)
{
  const auto rows = make_rows({ 1., std::numeric_limits<double>::infinity() });
  EXPECT_EQ(find_largest_row(rows, [](const Row &row) { return row[Column::Q]; }), &rows[0]);
}

namespace
{
  Row sliding(const double v, const double friction)
  {
    Row row;
    row[Column::v]                  = v;
    row[Column::mu]                 = 0.5;
    row[Column::normal_resultant]   = 10.;
    row[Column::friction_resultant] = friction;
    return row;
  }
} // namespace

TEST(FrictionHasTurned, OnceItIsNearlyWhatItIsInFullSliding)
{
  // In full sliding friction is 5 N. It turns from forward to backward, where stick may come back later, and forward again.
  const std::vector<Row> rows = { sliding(1., 5.),  sliding(-1., 5.), sliding(-1., -1.), sliding(-1., -4.6),
                                  sliding(-1., 0.), sliding(1., -5.), sliding(1., 2.) };
  EXPECT_EQ(friction_has_turned(rows), std::vector<bool>({ true, false, false, true, true, false, true }));
}

// A motion back that is shorter than stick has a largest P, too.
TEST(MovesWithFriction, CountsAllRowsWhereFrictionNeverTurns)
{
  std::vector<Row> rows = { sliding(1., 5.), sliding(-1., 4.), sliding(-1., 3.) };
  for (std::size_t i = 0; i < rows.size(); ++i)
    rows[i][Column::P] = 6. + 0.1 * static_cast<double>(i);
  EXPECT_EQ(moves_with_friction(rows, -1, Column::P), std::vector<bool>({ false, true, true }));
  EXPECT_EQ(peak_between_rows(rows, Column::P, moves_with_friction(rows, -1, Column::P)), 6.2);
}

// Q falls from 20 N through the turn to -2 N, with a mu that rises to that of the closed form, 0.5, only at last. It is largest
// in size as it goes through, and that counts for nothing; P is largest on its way, and that counts.
TEST(MovesWithFriction, CountsWhatIsBeyondBothSidesOfTheTurn)
{
  std::vector<Row> rows = { sliding(1., 5.), sliding(-1., -2.3), sliding(-1., -2.4), sliding(-1., -4.996), sliding(-1., -5.) };
  const double Q[] = { 20., 5., 3., -1., -2. }, P[] = { 6., 6.5, 7., 6.2, 6.1 };
  for (std::size_t i = 0; i < rows.size(); ++i)
  {
    rows[i][Column::Q]                 = Q[i];
    rows[i][Column::P]                 = P[i];
    rows[i][Column::x]                 = 0.;
    rows[i][Column::mu]                = std::abs(rows[i][Column::friction_resultant]) / 10.;
    rows[i][Column::theta_closed_form] = 0.;
    rows[i][Column::P_closed_form]     = 6.;
    rows[i][Column::Q_closed_form]     = -3.;
  }
  EXPECT_EQ(moves_with_friction(rows, -1, Column::Q), std::vector<bool>({ false, false, false, true, true }));
  EXPECT_EQ(moves_with_friction(rows, -1, Column::P), std::vector<bool>({ false, true, true, true, true }));
}

// Friction turns over rows 0.1 mm apart, P rises by 4 from row to row and then falls by 1; the corner lies a quarter behind
// row 3.
TEST(PeakBetweenRows, IsTheCornerAtWhichTheLastPointSlips)
{
  std::vector<Row> rows;
  for (const auto &[P, friction] : std::vector<std::pair<double, double>>{
           { 2., 5. }, { 6., 1. }, { 10., -3. }, { 14., -4.8 }, { 14.25, -5. }, { 13.25, -5. }, { 12.25, -5. } })
  {
    rows.push_back(sliding(-1., friction));
    rows.back()[Column::time] = 0.1 * static_cast<double>(rows.size());
    rows.back()[Column::x]    = -rows.back()[Column::time];
    rows.back()[Column::P]    = P;
    rows.back()[Column::Q]    = -P;
  }
  const auto counts = moves_with_friction(rows, -1, Column::P);
  EXPECT_NEAR(peak_between_rows(rows, Column::P, counts), 15., 1e-12);
  EXPECT_NEAR(peak_between_rows(rows, Column::Q, counts), -15., 1e-12);
  EXPECT_EQ(peak_between_rows(rows, Column::P, moves_with_friction(rows, 1, Column::P)), 0.);
  // With inertia forces have no corners: it is the vertex of a parabola.
  for (Row &row : rows)
    row[Column::kinetic_energy] = 0.;
  EXPECT_NEAR(peak_between_rows(rows, Column::P, counts), 14.25 + 0.375 * 0.375 / 2.5, 1e-12);
}
