// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "laws/friction_law.h"
#include "model/step/dynamic_model.h"

#include <deal.II/lac/full_matrix.h>

#include <array>

namespace sprag
{
  /// Complex amplitudes of some dofs.
  using ComplexAmplitudes = std::vector<std::complex<double>>;

  /// A contact whose points all slide at one speed, at given interface displacements.
  struct SlidingState
  {
    const dealii::Vector<double> &displacements;
    const DrivePoint &drive;
    double speed;                                  ///< of the cylinder's surface along the lever [mm/s], != 0
    const dealii::Vector<double> *rates = nullptr; ///< of the interface, which add to the slip; none: at rest
    ContactFriction friction            = ContactFriction::sliding;
    double friction_share               = 1.; ///< times mu of the law, 0 to 1: a friction on the way to the scene's
    std::optional<double> relaxation    = {}; ///< damping of the contact's spring over its stiffness here; none: the model's [s]
  };

  /// The law that a slide sees.
  inline FrictionLaw slide_friction(const FrictionLaw &friction, const SlidingState &sliding)
  {
    FrictionLaw law = step_friction(friction, sliding.drive.v);
    law.factor *= sliding.friction_share;
    return law;
  }

  /// Displacements of points along the lever, in lever axes [mm].
  struct SurfaceShape
  {
    std::vector<double> xi; ///< undeformed
    std::vector<double> along;
    std::vector<double> across;
  };

  /// Friction at a point that lags behind,
  ///   time tau' + tau = stiffness_row . z + rate_row . z',
  /// tau being its delayed traction and `force` the interface forces by a unit of that; see friction_lag(). Where a meshed mu
  /// falls with speed, what follows the speed is delayed, elsewhere all of the traction or a part.
  struct FrictionDelay
  {
    double time; ///< [s]; below 0 where slip runs away
    dealii::Vector<double> force;
    dealii::Vector<double> stiffness_row;
    dealii::Vector<double> rate_row;
  };

  /// Forces f on some dofs by a small perturbation z(t) of them, about a held slide, delays of friction apart:
  ///   f = (pressure + friction) z + (pressure_rate + friction_rate) z' - inertia z''
  /// `pressure` and `friction` are derivatives by displacements, of the pressure with the change of its direction and of
  /// friction. `pressure_rate` and `friction_rate` are derivatives by velocities, of contact damping and of friction, whose
  /// pressure and mu follow the velocities.
  struct LinearisedForces
  {
    LinearisedForces() = default;

    /// A perturbation without forces.
    explicit LinearisedForces(std::vector<unsigned int> dofs);

    /// Adds forces on some of these dofs, in any order.
    void add(const LinearisedForces &other);

    std::vector<unsigned int> dofs; ///< increasing
    dealii::FullMatrix<double> pressure;
    dealii::FullMatrix<double> friction;
    dealii::FullMatrix<double> pressure_rate;
    dealii::FullMatrix<double> friction_rate;
    dealii::FullMatrix<double> inertia; ///< coupling with a sprung support, symmetric
    std::vector<FrictionDelay> delays;  ///< of forces that are all in `friction` and `friction_rate`

    dealii::FullMatrix<double> stiffness() const; ///< df/dz, all of it
    dealii::FullMatrix<double> damping() const;   ///< df/dz'

    // Without the forces that are delayed.
    dealii::FullMatrix<double> immediate_stiffness() const;
    dealii::FullMatrix<double> immediate_damping() const;

    /// Complex forces by z exp(lambda t).
    ComplexAmplitudes forces(std::complex<double> lambda, const ComplexAmplitudes &z) const;

    /// Forces that friction's delays add to those without, by the displacements and by the velocities.
    struct DelayedForces
    {
      ComplexAmplitudes by_displacement;
      ComplexAmplitudes by_velocity;
    };
    DelayedForces by_delays(std::complex<double> lambda, const ComplexAmplitudes &z) const;

    /// Returns these forces with one delay a dof, all of the longest time T, where the delays are more. One of a shorter time t
    /// is then its share t/T of that and 1 - t/T without delay,
    ///   1 / (1 + lambda t) = 1 - t/T + (t/T) / (1 + lambda T) + O(lambda^2 t (T - t)),
    /// which is exact for equal times. Returns them as they are where that exceeds 1e-3 at `highest_rate`, |lambda| [1/s].
    LinearisedForces with_joined_delays(double highest_rate) const;
  };

  /// The matrices of linearised forces.
  inline constexpr std::array<dealii::FullMatrix<double> LinearisedForces::*, 5> force_matrices{
    { &LinearisedForces::pressure, &LinearisedForces::friction, &LinearisedForces::pressure_rate,
      &LinearisedForces::friction_rate, &LinearisedForces::inertia }
  };
} // namespace sprag
