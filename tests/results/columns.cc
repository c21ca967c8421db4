// SPDX-License-Identifier: GPL-3.0-only
#include "results/columns.h"

#include <cmath>
#include <gtest/gtest.h>
#include <map>

#include <string>
#include <vector>

using namespace sprag;

TEST(Columns, TheirUnitsAreThoseOfTheNumbers)
{
  using C                                                = Column;
  const std::map<std::string, std::vector<Column>> known = {
    { "s", { C::time, C::time_step } },
    { "rad", { C::theta, C::theta_closed_form } },
    { "rad/s", { C::theta_rate } },
    { "mm/s", { C::v, C::v_rel } },
    { "mm", { C::x, C::s, C::centre_offset, C::contact_width, C::largest_pressure_xi, C::penetration, C::indentation } },
    { "N", { C::P, C::F, C::Q, C::Q_support, C::P_quasi_static, C::Q_quasi_static, C::P_closed_form, C::Q_closed_form } },
    { "MPa", { C::largest_pressure } },
    { "N mm/s", { C::friction_power } },
    { "N mm", { C::friction_work, C::drive_work, C::spring_energy, C::elastic_energy, C::kinetic_energy, C::damping_work } }
  };
  for (const auto &[unit, columns] : known)
    for (const Column column : columns)
      EXPECT_EQ(column_info(column).unit, unit) << column_info(column).name;
}

TEST(Columns, OfAPairTellWhatTheSecondLeverHasAndWhatIsLeftBetweenThem)
{
  Row first, second;
  first[Column::theta]         = 0.10;
  first[Column::P]             = 10.;
  first[Column::F]             = 4.;
  first[Column::Q]             = 5.;
  first[Column::spring_energy] = 2.;
  first[Column::penetration]   = 1e-3;
  second                       = first;
  second[Column::theta]        = 0.06;
  second[Column::P]            = 8.;
  second[Column::Q]            = 3.;
  second[Column::penetration]  = 3e-3;
  EXPECT_EQ(first.drive_force(), 5.);
  first.add_second_lever(second);
  EXPECT_EQ(first.drive_force(), 8.);
  EXPECT_EQ(first.second_value(Column::P), 8.);
  EXPECT_NEAR(first.swing(), 0.02, 1e-15);
  // The first lever presses the cylinder down, the second one up; friction at an inclination takes from either.
  EXPECT_NEAR(first.lateral_force(), 8. * std::cos(0.06) - 4. * std::sin(0.06) - 10. * std::cos(0.1) + 4. * std::sin(0.1), 1e-14);
  EXPECT_EQ(first.lever_row(0)[Column::P], 10.);
  EXPECT_EQ(first.lever_row(1)[Column::P], 8.);
  EXPECT_EQ(first.lever_value(Column::theta, 1), 0.06);
  EXPECT_EQ(first[Column::P], 10.);
  EXPECT_EQ(first[Column::spring_energy], 4.);
  EXPECT_EQ(first[Column::penetration], 3e-3);
}
