// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "fe/algebra/matrix_rows.h"

#include <deal.II/base/point.h>

#include <vector>

namespace sprag
{
  /// Returns the place in the order of elimination of each unknown of a symmetric matrix, from 1 as MUMPS counts. The unknowns at
  /// `places` [mm] are halved by the line across either axis that couples the fewest nodes, until few are left. Nodes that couple
  /// two halves come last.
  std::vector<int> nested_dissection(const MatrixRows &matrix, const std::vector<dealii::Point<2>> &places);
} // namespace sprag
