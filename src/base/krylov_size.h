// SPDX-License-Identifier: GPL-3.0-only
#pragma once

namespace sprag
{
  // The size of the block Krylov space in which normal_modes() seeks modes; the memory of a run is estimated from it.

  constexpr unsigned int krylov_block_width = 4;

  /// Returns how many columns a restart keeps: those wanted and two or three blocks more.
  constexpr unsigned int kept_columns(const unsigned int n_modes)
  {
    return (n_modes / krylov_block_width + 3) * krylov_block_width;
  }

  /// Returns how many columns the space has at most.
  constexpr unsigned int most_columns(const unsigned int n_modes)
  {
    return 4 * kept_columns(n_modes);
  }
} // namespace sprag
