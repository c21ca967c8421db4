#include "results/row_statistics.h"

#include <gtest/gtest.h>
#include <limits>

using namespace sprag;

namespace
{
  std::vector<Row> rows_of(const std::vector<double> &values)
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
  const auto rows = rows_of({ no_number, 2., -5., no_number, 3. });
  const auto Q    = [](const Row &row) { return row[Column::Q]; };
  EXPECT_EQ(signed_peak(rows, Q), -5.);
  EXPECT_EQ(largest(rows, Q), 5.);
  EXPECT_EQ(largest(rows, Column::Q), 5.);
  EXPECT_EQ(sum(rows, Column::Q), 0.);
  EXPECT_EQ(row_of_largest(rows, Q), &rows[4]);
}

TEST(RowStatistics, OfNoNumbersAreZero)
{
  const auto rows = rows_of({ no_number });
  EXPECT_EQ(largest(rows, Column::Q), 0.);
  EXPECT_EQ(sum(rows, Column::Q), 0.);
  EXPECT_EQ(row_of_largest(rows, [](const Row &row) { return row[Column::Q]; }), nullptr);
}

TEST(RowStatistics, TakeARowOfAnInfiniteValueForNone)
{
  const auto rows = rows_of({ 1., std::numeric_limits<double>::infinity() });
  EXPECT_EQ(row_of_largest(rows, [](const Row &row) { return row[Column::Q]; }), &rows[0]);
}
