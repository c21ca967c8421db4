// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "base/choices.h"

#include <map>
#include <string>

namespace sprag
{
  /// The name of the parameter that names the material of a section.
  constexpr const char *material_parameter = "Made of";

  /// Cells of a row by the headings of their columns. Those of parameters bear the parameter's name; a number there may have a
  /// unit, as in "210 GPa".
  using Material = std::map<std::string, std::string>;

  /// Returns the rows of params/materials.md by the names of the materials, in the page's order behind "none", which is empty.
  const Choices<Material> &materials();
} // namespace sprag
