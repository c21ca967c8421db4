// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "model/step/linearisation.h"
#include "model/structure/modal_structure.h"

namespace sprag
{
  /// Solutions exp(lambda t) of a modal structure under linear forces at its interface, by increasing |lambda|. With
  /// displacements q of the modes and u of the loaded static shapes
  ///   q'' + C q' + omega^2 q = S^T f,   u + relaxation u' = G f,   f as in LinearisedForces, z = S q + u,
  /// and the tractions of friction's delays.
  /// Eigenvalues more than 1e10 times the smallest are left out, and -1 / relaxation, at which f = 0. Throws AnalysisError if
  /// LAPACK fails or the structure under these forces has a static mode, lambda = 0, exactly.
  /// Without `shapes` the eigenvalues alone are found.
  std::vector<StructureMode> modal_vibrations(const ModalData &data, const LinearisedForces &forces, bool shapes = true);
} // namespace sprag
