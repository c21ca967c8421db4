// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "fe/solid/solid_body.h"

namespace sprag
{
  /// Smooth loads on the bond between the skin and what is behind it: hats over a grid of xi and zeta, in each of three
  /// directions. Together they can carry any force and moment.
  struct BondGrid
  {
    double begin;        ///< along xi [mm]
    double end;          ///< beyond which hats go on as they are [mm]
    double spacing_xi;   ///< aimed at [mm]
    double spacing_zeta; ///< aimed at [mm]
  };

  /// Returns consistent nodal forces of the hats by the body's degrees of freedom, a column each; those that only the hub carries
  /// are left out. Empty for a body without skin.
  SparseColumns bond_loads(const SolidBody &body, const BondGrid &grid);
} // namespace sprag
