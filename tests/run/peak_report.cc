// SPDX-License-Identifier: GPL-3.0-only
#include "report/peak_report.h"
#include "report/report.h"
#include "scene/scene.h"
#include "scenes.h"
#include "support/find_value.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace sprag;

namespace
{
  Row row(const double x, const double v, const double pressure, const double width)
  {
    Row result;
    result[Column::x]                   = x;
    result[Column::v]                   = v;
    result[Column::largest_pressure]    = pressure;
    result[Column::largest_pressure_xi] = 185. - x;
    result[Column::contact_width]       = width;
    return result;
  }

  const std::vector<Row> rows = { row(0., 112., 0., 0.), row(65., 112., 0.2, 2.), row(64., -112., 0.3, 2.4) };
} // namespace

// Behind a reversal, while friction turns, the pressure stands out where the slip begins.
TEST(PeakReport, LooksWhereFrictionHasTurned)
{
  auto all = rows;
  for (const double share : { -1., 0.5, 1. })
  {
    all.push_back(row(63.9, -112., share == 0.5 ? 0.5 : 0.31, 2.4));
    all.back()[Column::mu]                 = 0.6;
    all.back()[Column::normal_resultant]   = 20.;
    all.back()[Column::friction_resultant] = -share * 0.6 * 20.;
  }
  all.erase(all.begin() + 2);
  std::vector<Entry> entries;
  add_largest_pressure(all, entries);
  EXPECT_EQ(find_value(entries, "largest_pressure"), 0.31);
}

// Model A's contact at x = 65 mm is 2.4 mm wide, and none at x = 0. Modes out of contact do not need it.
TEST(PeakReport, WarnsOfModesAndContactLawsOnAContactNarrowerThanAFace)
{
  Scene scene          = model_a();
  scene.analysis.model = ModelType::condensed;
  scene.mesh.degree    = 2;
  for (const auto type : { AnalysisType::modal, AnalysisType::contact_law, AnalysisType::calibration })
  {
    scene.analysis.type  = type;
    scene.mesh.face_size = 2.;
    EXPECT_TRUE(narrow_contact_warnings(scene).empty());
    scene.mesh.face_size = 3.;
    const auto warnings  = narrow_contact_warnings(scene);
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_NE(warnings[0].found.find("At x = 65 mm the contact is about 2."), std::string::npos) << warnings[0].found;
  }
  scene.analysis.type     = AnalysisType::modal;
  scene.stability.contact = HeldContact::open;
  EXPECT_TRUE(narrow_contact_warnings(scene).empty());
  scene.analysis.type = AnalysisType::stability; // estimates its errors
  EXPECT_TRUE(narrow_contact_warnings(scene).empty());
}

// Widths about those of model A.
TEST(PeakReport, WarnsOfAContactThatIsNarrowOverMoreThanAQuarterOfItsWay)
{
  std::vector<Row> stroke;
  for (int x = 0; x <= 65; ++x)
    stroke.push_back(row(x, 112., 0.003 * x, 0.24 * std::sqrt(x)));
  Scene scene          = model_a();
  scene.mesh.face_size = 0.25; // narrower than 2.5 elements below x = 7 mm
  EXPECT_TRUE(coarse_contact_warnings(scene, stroke).empty());
  scene.mesh.face_size = 0.5; // below 27 mm
  const auto warnings  = coarse_contact_warnings(scene, stroke);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].found.find("1.97"), std::string::npos) << warnings[0].found;
}

TEST(PeakReport, TakesTheScatterOfPassingElementsOffTheLargestPressure)
{
  // A parabola with its summit of 0.5 MPa at x = 40 mm, and elements that raise every third row by 2 %.
  std::vector<Row> all;
  for (unsigned int x = 0; x <= 65; ++x)
    all.push_back(row(x, 112., 0.5 * (1. - std::pow((x - 40.) / 100., 2)) * (x % 3 == 0 ? 1.02 : 1.), 3.));
  const auto found = smoothed_largest_pressure(all, 0.25);
  EXPECT_NEAR(found.value, 0.5 * (1. + 0.02 / 3.), 0.002);
  EXPECT_NEAR(found.scatter, 0.02 * std::sqrt(2. / 9.), 0.004); // of one in three
  std::vector<Entry> entries;
  add_largest_pressure(all, entries, 0.25);
  EXPECT_EQ(find_value(entries, "largest_pressure"), found.value);
}
