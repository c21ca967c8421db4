#include "results/columns.h"

#include <gtest/gtest.h>
#include <set>

using namespace sprag;

TEST(Columns, TableFollowsTheEnumeration)
{
  ASSERT_EQ(all_columns().size(), n_columns);
  EXPECT_EQ(column_info(Column::time).name, "time");
  EXPECT_EQ(column_info(Column::P).name, "P");
  EXPECT_EQ(column_info(Column::Q).name, "Q");
  EXPECT_EQ(column_info(Column::v_rel).name, "v_rel");
  EXPECT_EQ(column_info(Column::contact_width).name, "contact_width");
  EXPECT_EQ(column_info(Column::elastic_energy).name, "elastic_energy");
  EXPECT_EQ(column_info(Column::theta_closed_form).name, "theta_closed_form");
  EXPECT_EQ(column_info(Column::augmentations).name, "augmentations");
}

TEST(Columns, EachHasItsOwnNameAUnitAndAMeaning)
{
  std::set<std::string> names;
  for (const ColumnInfo &column : all_columns())
  {
    EXPECT_TRUE(names.insert(column.name).second) << column.name;
    EXPECT_FALSE(column.unit.empty()) << column.name;
    EXPECT_FALSE(column.description.empty()) << column.name;
  }
}
