// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include <string>

namespace sprag
{
  /// Returns how many of unit `to` one of unit `from` is, as 1000 of "GPa" to "MPa", by UDUNITS-2 and therefore its grammar: "N
  /// m/rad", "kg/m3", "mm/s^2". An empty unit and "-" are dimensionless; "g" is standard gravity where a gram does not fit, "deg"
  /// a degree. A radian is a dimension of its own. Throws InputError that names both dimensions where they differ.
  double unit_factor(const std::string &from, const std::string &to);
} // namespace sprag
