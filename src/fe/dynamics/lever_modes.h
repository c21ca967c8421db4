// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "fe/body/body_mass.h"
#include "model/step/vibration.h"

namespace sprag
{
  /// Modes of undamped vibration of a lever on its rotational spring, out of contact, by increasing frequency, with a modal mass
  /// of 1 t. Coordinates: elastic displacements of the body in axes that turn with its hub, vibrations of the leaf spring with
  /// the hub held, and the hub's rotation.
  struct ModeShapes
  {
    std::vector<double> stiffness;                     ///< omega^2 [1/s^2]
    std::vector<dealii::Vector<double>> displacements; ///< elastic, of all degrees of freedom of the body
    std::vector<double> rotation;                      ///< of the hub
  };

  /// Mode shapes with the masses and momenta that a condensed lever needs.
  struct LeverModes : ModeShapes, MassSums
  {
    std::vector<std::vector<double>> leaf; ///< vibrations of the leaf spring
    std::vector<std::array<double, 2>>
        momentum; ///< of rho times the total displacement along xi and eta, leaf spring included [t]
    std::vector<Eigenmode::AcrossShares> across; ///< in space
    dealii::FullMatrix<double> layer_stiffness;  ///< of the friction layer, in the modes
  };

  /// Finds the lowest `n` modes, by shift and invert with the body's answer to forces. Throws InputError as BodyMass,
  /// AnalysisError where a residual is too large.
  template <int dim>
  LeverModes lever_modes(const ElasticBody<dim> &body, const Response &response, const LeverInertia &inertia,
                         double spring_stiffness, unsigned int n);

  /// Finds the shares of vibrations in space in motion as in a plane, in twisting and along the cylinder's axis, as the means of
  /// the modes' own. `structures`: the modes of each structure whose coordinates a vibration has, one after the other.
  void find_across_shares(const std::vector<const LeverModes *> &structures, std::vector<Eigenmode> &vibrations);
} // namespace sprag
