#include "analysis/peak_report.h"
#include "analysis/report.h"
#include "scenes.h"

#include <gtest/gtest.h>

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

TEST(PeakReport, TellsTheLargestPressureAndWhereItIs)
{
  std::vector<Entry> entries;
  add_largest_pressure(rows, entries);
  ASSERT_EQ(entries.size(), 4u);
  EXPECT_EQ(value_of(entries, "largest_pressure"), 0.3);
  EXPECT_EQ(value_of(entries, "largest_pressure_x"), 64.);
  EXPECT_EQ(value_of(entries, "largest_pressure_xi"), 121.);
  EXPECT_EQ(std::get<std::string>(entries[2].value), "backward");
}

TEST(PeakReport, IsEmptyWithoutAFace)
{
  std::vector<Entry> entries;
  add_largest_pressure({ Row() }, entries);
  EXPECT_TRUE(entries.empty());
  EXPECT_TRUE(coarse_contact_warnings(model_a(), { Row() }).empty());
}

TEST(PeakReport, WarnsOfAContactOfFewElements)
{
  Scene scene          = model_a();
  scene.mesh.face_size = 0.5; // 4.8 elements, 0.7 % expected
  EXPECT_TRUE(coarse_contact_warnings(scene, rows).empty());
  scene.mesh.face_size = 1.2; // two elements, 10 %
  const auto warnings  = coarse_contact_warnings(scene, rows);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].found.find("2 times"), std::string::npos) << warnings[0].found;
  EXPECT_NE(warnings[0].effect.find("10 %"), std::string::npos) << warnings[0].effect;
  scene.mesh.face_size = 0.5;
  scene.mesh.degree    = 1; // 13 % expected
  EXPECT_EQ(coarse_contact_warnings(scene, rows).size(), 1u);
}
