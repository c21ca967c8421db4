// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "model/structure/modal_structure.h"

namespace sprag
{
  struct Device;

  /// Hermite elements of equal length along a lever's axis, from the pivot to the tip. No elements: a rigid lever.
  struct BeamMesh
  {
    unsigned int elements = 0;
    double length         = 0.; ///< of the lever [mm]

    double element_length() const
    {
      return length / elements;
    }
    /// Returns the number of dofs in lever axes: at node 1, 2, ... deflection along eta [mm] and slope [rad].
    unsigned int n_dofs() const
    {
      return 2 * elements;
    }
  };

  /// Euler-Bernoulli lever at the neutral axis' offset on its rotational spring, in all modes of its elements; mass by
  /// mass_per_length(), modal damping on each bending mode, Rayleigh damping, tip mass, the leaf spring's
  /// own vibrations, and the support if it is sprung.
  ModalData beam_modes(const Device &device, const BeamMesh &mesh);

  /// Mass of lever and leaf spring, which moves with a sprung support [t].
  double carried_mass(const Device &device);
} // namespace sprag
