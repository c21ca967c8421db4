// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "fe/dynamics/condensed_basis.h"
#include "fe/dynamics/sparse_structure.h"

namespace sprag
{
  constexpr double bar_spring = 1e4; ///< [N mm/rad]

  /// Constants of a small lever without damping.
  inline LeverDynamics undamped_dynamics(const bool sprung)
  {
    LeverDynamics result;
    result.spring_stiffness  = bar_spring;
    result.sprung            = sprung;
    result.support_mass      = 2e-5;
    result.support_stiffness = 50.;
    return result;
  }

  /// The same with damping of every kind.
  inline LeverDynamics damped_dynamics(const bool sprung)
  {
    LeverDynamics result     = undamped_dynamics(sprung);
    result.mass_damping      = 20.;
    result.stiffness_damping = 1e-7;
    result.relaxation        = 2e-5;
    result.modal_damping     = 0.02;
    result.support_damping   = 1e-3;
    return result;
  }

  /// Vibrations of a lever out of contact on its spring.
  inline LeverModes modes_on_spring(const ElasticBody<2> &body, const LeverInertia &inertia, const unsigned int number,
                                    const double spring = bar_spring)
  {
    return lever_modes(body, make_response(body), inertia, spring, number);
  }

  inline SparseStructure sparse_structure(const ElasticBody<2> &body, const LeverInertia &inertia, const unsigned int modes,
                                          const LeverDynamics &constants)
  {
    const auto matrices = std::make_shared<InertialMatrices>(body, inertia);
    return SparseStructure(body, matrices, modes_on_spring(body, inertia, modes), constants);
  }
} // namespace sprag
