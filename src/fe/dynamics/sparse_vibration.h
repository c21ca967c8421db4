// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "fe/dynamics/sparse_structure.h"
#include "model/step/linearisation.h"
#include "model/step/vibration.h"

#include <vector>

namespace sprag
{
  /// Largest backward error of what sparse_vibrations() returns: of the residual A^-1 E s - s / lambda of the first-order problem
  /// over s / lambda, as roots of |lambda|^2 q^T M q + q'^T M q'. An eigenvalue is wrong by that share times its condition, which
  /// is 1 without friction and damping and grows as |lambda| / |Delta lambda| where two meet, to some 10 in a flutter.
  /// Round-off leaves much less, some 1e-10 at 10 kHz with 4e4 unknowns, but grows with their number, with frequency and with
  /// friction: 2e-8 at three times the mu of cork.
  constexpr double largest_backward_error = 1e-6;

  /// Returns at least the `number` vibrations exp(lambda t) of smallest |lambda|, Im lambda > 0, under linear forces at the
  /// interface, and what grows or was found below them without vibrating, by increasing |lambda|; of a structure that has fewer
  /// those found so well. The method of Arnoldi for the inverse of the linearised problem, see InverseProblem, in a space of no
  /// more than 100 dimensions and 12 for each. Throws AnalysisError if they are not found in it, or not that well.
  std::vector<StructureMode> sparse_vibrations(const SparseStructure &structure, const LinearisedForces &forces,
                                               unsigned int number);
} // namespace sprag
