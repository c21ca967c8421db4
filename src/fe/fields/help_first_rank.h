// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "fe/fields/shared_writing.h"

namespace sprag
{
  /// Builds bodies with the first rank and takes part in their solves and in what is found and written of their fields, as long
  /// as it has RanksAtHand. To be called by the others.
  void help_first_rank(MPI_Comm ranks);

  /// Returns the present ranks as those that write fields with this process, the first.
  Writers writers_at_hand();
} // namespace sprag
