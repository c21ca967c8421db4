// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "fe/dynamics/inertial_matrices.h"
#include "fe/solid/solid_body.h"
#include "model/vibration.h"

namespace sprag
{
  /// Modes of undamped vibration of the lever on its rotational spring, out of contact, by increasing frequency, with a modal
  /// mass of 1 t. Coordinates: elastic displacements of the body in axes that turn with its hub, vibrations of the leaf spring
  /// with the hub held, and the hub's rotation.
  struct SolidModes
  {
    std::vector<double> stiffness;                     ///< omega^2 [1/s^2]
    std::vector<dealii::Vector<double>> displacements; ///< elastic, of all degrees of freedom of the body
    std::vector<double> rotation;                      ///< of the hub
    std::vector<std::array<double, 2>>
        momentum; ///< of rho times the total displacement along xi and eta, leaf spring included [t]
    std::vector<Eigenmode::AcrossShares> across;
    dealii::FullMatrix<double> layer_stiffness; ///< of the friction layer, in the modes
    double density_factor    = 1.;              ///< by which the densities were scaled to meet the moment of inertia
    double total_mass        = 0.;              ///< [t]
    double moment_of_inertia = 0.;              ///< about the pivot [t mm^2]
  };

  /// Finds the lowest `n` modes, by shift and invert with the body's factors. Throws InputError where hub, tip mass and leaf
  /// spring alone have more than the moment of inertia or nothing carries the tip mass, AnalysisError where a residual is too
  /// large.
  SolidModes solid_modes(const SolidBody &body, const LeverInertia &inertia, double spring_stiffness, unsigned int n);

  /// Tells how vibrations move, as far as the modes' own motions tell it. `structures`: the modes of each structure whose
  /// coordinates a vibration has, one after the other.
  void tell_motion(const std::vector<const SolidModes *> &structures, std::vector<Eigenmode> &vibrations);
} // namespace sprag
