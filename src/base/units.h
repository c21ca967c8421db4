// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include <string>

namespace sprag
{
  /// Returns whether a text is a unit.
  bool is_unit(const std::string &text);

  /// Returns the factor that converts numbers in one unit to another, 1000 from "GPa" to "MPa", by the grammar of UDUNITS-2: "N
  /// m/rad", "kg/m3", "mm/s^2". An empty unit and "-" are dimensionless; "g" is standard gravity where a gram does not fit, "deg"
  /// a degree. A radian is a dimension of its own. Throws InputError that names both dimensions where they differ.
  double unit_factor(const std::string &from, const std::string &to);
} // namespace sprag
