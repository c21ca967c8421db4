#include "analysis/accuracy/error_estimate.h"
#include "analysis/accuracy/slide_samples.h"

#include <cmath>
#include <gtest/gtest.h>

using namespace sprag;

namespace
{
  /// A row in which the whole contact slides, or only a share of it.
  Row row(const double time, const double x, const double v, const double P, const double share = 1.)
  {
    Row result;
    result[Column::time]               = time;
    result[Column::x]                  = x;
    result[Column::v]                  = v;
    result[Column::P]                  = P;
    result[Column::normal_resultant]   = P;
    result[Column::mu]                 = 0.5;
    result[Column::friction_resultant] = (v < 0. ? -0.5 : 0.5) * share * P;
    result[Column::largest_pressure]   = P;
    result[Column::contact_width]      = 2.;
    return result;
  }

  /// There and back over 20 mm in steps of 1 mm; behind the turning point the contact sticks for 3 mm.
  std::vector<Row> there_and_back()
  {
    std::vector<Row> rows;
    for (unsigned int i = 0; i <= 20; ++i)
      rows.push_back(row(i, i, 1., 0.1 * i));
    for (unsigned int i = 1; i <= 20; ++i)
      rows.push_back(row(20. + i, 20. - i, -1., 0.2 * (20. - i), i <= 3 ? 0.5 : 1.));
    return rows;
  }
} // namespace

TEST(ErrorEstimate, OfTheFinerResultIsAShareOfTheDifference)
{
  // Values 3 + 5 h^2 at h = 0.2 and 0.1: the finer is 0.05 off.
  EXPECT_NEAR(share_of_finer(2., 2.) * ((3. + 5. * 0.04) - (3. + 5. * 0.01)), 0.05, 1e-14);
  EXPECT_DOUBLE_EQ(share_of_finer(3., 1.), 0.5);
}

TEST(ErrorEstimate, AddsItsPartsAndNamesTheLargest)
{
  const ErrorEstimate estimate{ "P", "its peak", { { "mesh", 1e-3, "" }, { "penalty", 3e-3, "" } }, "" };
  EXPECT_DOUBLE_EQ(total_error(estimate), 4e-3);
  EXPECT_EQ(largest_part(estimate).name, "penalty");
  EXPECT_TRUE(std::isnan(total_error({ "P", "", {}, "No estimate." })));
}

TEST(SlideSamples, LieWhereAllSlidesAndTheTurnIsForgotten)
{
  const auto samples = slide_samples(there_and_back(), 4);
  ASSERT_GE(samples.size(), 8u);
  double time           = -1.;
  unsigned int backward = 0;
  for (const Row &sample : samples)
  {
    EXPECT_GT(sample[Column::time], time);
    time = sample[Column::time];
    if (sample[Column::v] < 0.)
    {
      ++backward;
      EXPECT_LE(sample[Column::x], 16.);
    }
    EXPECT_GT(sample[Column::P], 0.);
  }
  EXPECT_EQ(backward, 5u); // four and the one of the largest P
  EXPECT_EQ(samples[4][Column::x], 20.);
  EXPECT_TRUE(slide_samples({ row(0., 0., 1., 0.) }, 4).empty());
}
