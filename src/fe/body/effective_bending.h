// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "fe/body/elastic_body.h"

#include <vector>

namespace sprag
{
  /// The Euler-Bernoulli beam, clamped at the pivot, that bends most like a meshed lever.
  struct EffectiveBending
  {
    double stiffness;           ///< EI [N mm^2]
    double neutral_axis_offset; ///< e_a [mm], of its axis from the pivot
    double deflection_error;    ///< of the deflections of the friction face, root mean square over the largest
  };

  /// Finds the beam that bends most like a lever. A unit load across the lever's end face at xi = L moves the friction face, at
  /// eta = e, as by Maxwell's theorem loads on the face would move the end. For the beam
  ///   u_eta = xi^2 (3 L - xi) / (6 EI),   u_xi = (e_a - e) xi (2 L - xi) / (2 EI),
  /// fitted by least squares between two places of the face [mm], which a cylinder sweeps. Requires an end face, see end_face().
  EffectiveBending effective_bending(const ElasticBody<2> &body, double from, double to);
} // namespace sprag
