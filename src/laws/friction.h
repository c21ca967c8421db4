// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "laws/friction_law.h"

#include <vector>

namespace sprag
{
  /// Returns the pieces of a law that consists of such, falls nowhere, and so lets a load slip at one speed alone; the first one
  /// from 0. Other laws have none.
  std::vector<FrictionPiece> rising_pieces(const FrictionLaw &law);

  /// Returns true if mu falls with speed; in a table by more than 1 % of its largest value.
  bool falls_with_speed(const FrictionLaw &law);
} // namespace sprag
