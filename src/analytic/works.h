// SPDX-License-Identifier: GPL-3.0-only
#pragma once

namespace sprag
{
  /// Energies at an instant [N mm].
  struct StoredEnergy
  {
    double kinetic = 0.;
    double spring  = 0.; ///< rotational spring
    double elastic = 0.; ///< lever and friction layer, or the contact law of the layer
    double layer   = 0.; ///< the friction layer's part of it; NaN if unknown
    double support = 0.;
    double contact = 0.; ///< springs of the penalties, normal and tangential: numerical

    /// Returns the sum, in which that of the layer is contained already.
    double total() const
    {
      return kinetic + spring + elastic + support + contact;
    }
  };

  /// Works done in a step [N mm], each from forces times displacements or the scheme's own formula, none as a remainder.
  struct StepWork
  {
    double drive       = 0.; ///< by the drive
    double friction    = 0.; ///< dissipated by friction
    double damping     = 0.; ///< dissipated by structure, support and contact damping
    double algorithmic = 0.; ///< dissipated by the time integration
    double creep       = 0.; ///< slip below the regularisation speed [mm]

    void operator+=(const StepWork &other)
    {
      drive += other.drive;
      friction += other.friction;
      damping += other.damping;
      algorithmic += other.algorithmic;
      creep += other.creep;
    }
  };
} // namespace sprag
