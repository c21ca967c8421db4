// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "base/parameters.h"

#include <functional>
#include <string>
#include <vector>

namespace sprag
{
  // Units that depend on other parameters: an end of a map has that of the parameter which the map names, the stiffness of a
  // contact N/mm^n with its exponent n.

  /// Returns the value of a parameter by its full name, the default where none is given.
  using LookUp = std::function<std::string(const std::string &name)>;

  /// Returns a number, with or without a unit, in the unit that the parameter has beside the values of others. Throws InputError
  /// with what it must be.
  double in_own_unit(const std::vector<Parameter> &declared, const Parameter &parameter, const std::string &text,
                     const LookUp &look_up);

  /// Returns "SECTION/NAME FROM TO; ..." with both ends in the parameter's unit, without it. Entries that are not of this form
  /// stay as they are. Throws InputError where a unit does not fit.
  std::string ranges_in_own_units(const std::vector<Parameter> &declared, const std::string &text, const LookUp &look_up);
} // namespace sprag
