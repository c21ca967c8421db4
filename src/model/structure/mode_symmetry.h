// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "model/interface/interface_layout.h"
#include "model/step/vibration.h"

#include <vector>

namespace sprag
{
  /// Eigenvalues no farther apart than this share of |lambda| count as one.
  constexpr double tie = 1e-7;

  bool are_tied(const StructureMode &a, const StructureMode &b);

  /// Symmetry of a mode of a pair: 1 where the levers mirror each other, -1 where the second does the opposite.
  double symmetric_share(const ComplexVector &displacements, const InterfaceLayout &layout);

  /// Two modes of a pair with one eigenvalue, as levers have that feel nothing of each other, are known up to their combinations.
  /// Puts the combination that mirrors most in place of the first and the one orthogonal to it in place of the second: where the
  /// levers are alike, one mirrors and the other swings. `displacements` holds those of the whole interface in each mode.
  void separate_ties(std::vector<StructureMode> &modes, std::vector<ComplexVector> &displacements, const InterfaceLayout &layout);
} // namespace sprag
