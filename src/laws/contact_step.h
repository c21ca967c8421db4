// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "laws/friction_law.h"

#include <deal.II/base/tensor.h>

namespace sprag
{
  /// Unilateral spring p = stiffness delta^exponent of the overlap delta = max(0, -gap).
  struct NormalLaw
  {
    double stiffness = 0.; ///< > 0
    double exponent  = 1.; ///< >= 1
  };

  /// The spring over a step. Energies per area [N/mm] or whole [N mm], as the stiffness is.
  struct MeanNormalForce
  {
    double begin;  ///< p at the beginning
    double end;    ///< p at the end
    double d_end;  ///< dp/dgap at the end
    double mean;   ///< mean of p over the change of the gap: minus the change of the energy over it
    double d_mean; ///< its derivative by the gap at the end
    double energy; ///< at the end
  };

  MeanNormalForce mean_normal_force(const NormalLaw &law, double gap_begin, double gap_end);

  /// Dashpot beside the spring, -damping * gap_rate while closed; it cannot pull the surfaces together.
  struct EndDamping
  {
    double force;
    double d_normal; ///< derivative by the spring's force
    double d_rate;   ///< derivative by the rate of the gap
  };

  EndDamping end_damping(double damping, double normal, double gap, double gap_rate);

  /// The memory of friction from the end of the last step, over the slips of a point.
  template <int slips>
  struct FrictionHistory
  {
    dealii::Tensor<1, slips> traction;
    dealii::Tensor<1, slips> slip_speed; ///< mean of the last step; 0 after stick [mm/s]
    double step = 0.;                    ///< its duration [s]
  };

  /// Friction over a step, see end_friction().
  template <int slips>
  struct EndFriction
  {
    dealii::Tensor<1, slips> traction;
    dealii::Tensor<2, slips> d_slip;     ///< derivative by the change of slip
    dealii::Tensor<1, slips> d_pressure; ///< derivative by the pressure at the end
    double mu     = 0.;
    bool slipping = false;
    dealii::Tensor<1, slips> slip_speed; ///< mean of the step; 0 in stick
    double energy     = 0.;              ///< of the tangential spring at the end
    double dissipated = 0.;              ///< in the step
    double creep      = 0.;              ///< slip below the regularisation speed [mm]
  };

  /// Traction over pressure where a contact slides, and its derivative by the slip speed.
  struct SlidingFriction
  {
    double coefficient = 0.; ///< signed as the speed
    double derivative  = 0.; ///< [s/mm]
  };

  /// mu(|w|) sgn(w), or mu(|w|) w / sqrt(w^2 + v_r^2) with a regularisation speed v_r; w != 0 [mm/s].
  SlidingFriction sliding_friction(const FrictionLaw &law, double speed);

  /// Friction at the end of a step of duration dt > 0 [s] in which the contact slips by `slip_change`: stick with a spring of the
  /// given stiffness > 0, or slip with |t| = mu(w) p, where w is the slip speed at the end, extrapolated along t from this step
  /// and the last (second order). With a regularisation speed v_r > 0 there is no stick: t = mu(|w|) p w / sqrt(w^2 + v_r^2)
  /// along the mean slip.
  template <int slips>
  EndFriction<slips> end_friction(const FrictionHistory<slips> &history, double stiffness,
                                  const dealii::Tensor<1, slips> &slip_change, double pressure, const FrictionLaw &law,
                                  double dt);
} // namespace sprag
