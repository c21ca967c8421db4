// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "fe/fields/shared_writing.h"

namespace sprag
{
  /// Takes part in the work of the first rank as long as that has RanksAtHand: builds its bodies, solves, and finds and writes
  /// fields. All other ranks call it.
  void help_first_rank(MPI_Comm ranks);

  /// Returns the present ranks as those that write fields with this process, the first.
  Writers writers_at_hand();
} // namespace sprag
