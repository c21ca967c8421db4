// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "laws/point_law.h"
#include "model/step/contact_point.h"
#include "model/step/generalised_alpha.h"

#include <array>

namespace sprag
{
  /// The place in a step where the forces of its contact are balanced.
  enum class ForceBalance
  {
    mean, ///< in time: between beginning and end, as the time integration does
    end   ///< without inertia: at the end
  };

  /// Constants of a contact in one step. Per area at points of a face, whole forces at a point contact.
  struct StepContactLaw
  {
    NormalLaw normal;
    double damping = 0.; ///< force over rate of approach while closed [N s/mm]
    SlipLaw slip;
    StepWeights weights{};
    ForceBalance balance = ForceBalance::mean; ///< at the end the spring is linear and has no dashpot
    FrictionMode mode    = FrictionMode::cone; ///< counts for a balance at the end
  };

  /// Geometry of a contact point over a step, in n coordinates q. Rows "of the step" stand where generalised-alpha balances
  /// forces, at (1 - alpha_f) q_1 + alpha_f q_0, that is at the middle and the delay later; in [q], the change of q over the
  /// step,
  ///   row . [q] = [gap] + delay * gap_bend
  /// up to third order, and so for slip.
  template <int n>
  struct StepKinematics
  {
    double gap_begin = 0.;
    double gap_end   = 0.;
    dealii::Tensor<1, n> gap_row_end;     ///< d(gap_end)/dq_1
    dealii::Tensor<1, n> gap_row;         ///< of the step
    dealii::Tensor<2, n> gap_curvature;   ///< d(gap_row)/dq_1
    double slip_change = 0.;              ///< [mm]
    dealii::Tensor<1, n> slip_change_row; ///< d(slip_change)/dq_1
    dealii::Tensor<1, n> slip_row;        ///< of the step
    dealii::Tensor<2, n> slip_curvature;  ///< d(slip_row)/dq_1
    double gap_bend     = 0.;             ///< [q] . d(gap_row)/dq [q] at the place of the rows [mm]
    double slip_bend    = 0.;             ///< [q] . d(slip_row)/dq [q] [mm]
    double gap_rate_end = 0.;             ///< counts with contact damping only [mm/s]
    dealii::Tensor<1, n> gap_rate_row;    ///< d(gap_rate_end)/dq_1
    double slip_shift = 0.;               ///< see return_to_cone(); counts for a balance at the end [mm]
  };

  /// A step that ends at a point's kinematics and is balanced there, from where the slip coordinate was `slip_begin` [mm].
  template <int n>
  StepKinematics<n> step_to(const ContactKinematics<n> &end, const double slip_begin)
  {
    StepKinematics<n> result;
    result.gap_begin = result.gap_end = end.gap;
    result.gap_row_end = result.gap_row = end.gap_row;
    result.gap_curvature                = end.gap_curvature;
    result.slip_change                  = end.slip - slip_begin;
    result.slip_change_row = result.slip_row = end.slip_row;
    result.slip_curvature                    = end.slip_curvature;
    return result;
  }

  /// Sets rows, curvatures and bends of a step whose forces are balanced where the point has the kinematics `balance`, at a
  /// `share` of the `change` of the coordinates.
  template <int n>
  void set_balance(const ContactKinematics<n> &balance, const double share, const dealii::Tensor<1, n> &change,
                   StepKinematics<n> &step)
  {
    step.gap_row        = balance.gap_row;
    step.gap_curvature  = share * balance.gap_curvature;
    step.gap_bend       = change * (balance.gap_curvature * change);
    step.slip_row       = balance.slip_row;
    step.slip_curvature = share * balance.slip_curvature;
    step.slip_bend      = change * (balance.slip_curvature * change);
  }

  /// Tractions at a contact point.
  struct PointTraction
  {
    double pressure = 0.; ///< damping included
    Slip traction;        ///< positive where the slip coordinate grows
    double mu     = 0.;
    bool slipping = false;
    ContactHistory history;
  };

  /// The response of a contact point to a step: its tractions at the end and its forces.
  template <int n>
  struct StepResponse : PointTraction
  {
    double mean_traction = 0.;    ///< of the step
    dealii::Tensor<1, n> force;   ///< of the step, generalised
    dealii::Tensor<2, n> tangent; ///< d(force)/dq_1, unsymmetric
    double d_shift     = 0.;      ///< derivative of the traction by the slip's shift [N/mm^3]
    double energy      = 0.;      ///< of the springs at the end of the step
    double friction    = 0.;      ///< works dissipated in the step
    double damping     = 0.;
    double algorithmic = 0.;
    double creep       = 0.; ///< slip below the regularisation speed [mm]
  };

  inline SlipHistory<double, 1> slip_history(const ContactHistory &history)
  {
    return { { { history.traction[0] } }, { { history.slip_speed[0] } }, history.mu, history.step };
  }

  /// Numbers with derivatives by the gap at the end of a step, by its slip, and by what stands beside these: the shift of the
  /// slip where forces are balanced at the end, else the rate of the gap.
  using StepNumber = Dual<double, 3>;

  /// Sets tractions at the end of a step, its force and the derivative of that.
  template <int n>
  void set_response(const StepKinematics<n> &point, const StepNumber &end_pressure, const PointFriction<StepNumber, 1> &end,
                    const StepNumber &pressure, const StepNumber &traction, StepResponse<n> &response)
  {
    const auto to_row = [&](const StepNumber &a)
    { return a.d[0] * point.gap_row_end + a.d[1] * point.slip_change_row + a.d[2] * point.gap_rate_row; };
    response.pressure = end_pressure.v;
    response.mu       = end.mu;
    response.slipping = end.slipping;
    response.force    = pressure.v * point.gap_row - traction.v * point.slip_row;
    response.tangent  = outer_product(point.gap_row, to_row(pressure)) + pressure.v * point.gap_curvature -
                       outer_product(point.slip_row, to_row(traction)) - traction.v * point.slip_curvature;
    response.traction[0]      = end.traction[0].v;
    response.mean_traction    = traction.v;
    response.history.traction = response.traction;
  }

  /// A balance at the end of a step: tractions and forces there. The history holds the multipliers of the current augmentation. A
  /// point that was open has no traction to start from: its slip history begins with the step in which it touches.
  template <int n>
  StepResponse<n> end_response(const StepKinematics<n> &point, const ContactHistory &history, const StepContactLaw &law)
  {
    using N = StepNumber;
    StepResponse<n> response;
    const N pressure = history.normal_multiplier - law.normal.stiffness * variable<N>(point.gap_end, 0);
    if (!(pressure.v > 0.))
      return response;
    PointFriction<N, 1> friction;
    const Several<N, 1> slip{ { variable<N>(point.slip_change, 1) } };
    friction.traction = stick_traction(law.slip, slip_history(history).traction, slip);
    if (law.mode == FrictionMode::cone)
      friction = return_to_cone(law.slip, friction.traction, pressure, law.weights.dt,
                                Several<N, 1>{ { variable<N>(point.slip_shift, 2) } }, slip);
    set_response(point, pressure, friction, pressure, friction.traction[0], response);
    response.d_shift = friction.traction[0].d[2];
    return response;
  }

  /// Forces of a step consistent with the time integration: the spring's pressure is the mean over the change of the gap
  /// (discrete gradient), so that opening and closing make no energy; friction, returned to the cone at the end of the step, acts
  /// with the mean of both ends; both with the delay of generalised-alpha, whose work is the scheme's dissipation.
  template <int n>
  StepResponse<n> mean_response(const StepKinematics<n> &point, const ContactHistory &history, const StepContactLaw &law)
  {
    using N = StepNumber;
    StepResponse<n> response;
    const double delay = law.weights.delay(), alpha = law.weights.alpha_f;
    const N gap        = variable<N>(point.gap_end, 0);
    const double begin = spring_force(law.normal, point.gap_begin);
    const N end        = spring_force(law.normal, gap);
    const N mean       = mean_spring_force(law.normal, point.gap_begin, gap);
    const N dashpot    = dashpot_force(law.damping, end, gap, variable<N>(point.gap_rate_end, 2));
    const N damped     = (1. - alpha) * dashpot + alpha * history.damping;
    const N pressure   = mean + delay * (end - begin) + damped;
    const Several<N, 1> slip{ { variable<N>(point.slip_change, 1) } };
    const auto before   = slip_history(history);
    const auto friction = end_friction(law.slip, before, slip, N(end + dashpot), law.weights.dt);
    if (mean.v == 0. && end.v == 0. && history.damping == 0. && history.traction == Slip())
      return response;

    const double gap_change = point.gap_end - point.gap_begin;
    const N traction        = (0.5 + delay) * friction.traction[0] + (0.5 - delay) * before.traction[0];
    const double work       = -(end.v - begin) * gap_change - pressure.v * point.gap_bend +
                        (friction.traction[0].v - before.traction[0]) * point.slip_change + traction.v * point.slip_bend;
    set_response(point, N(end + dashpot), friction, pressure, traction, response);
    response.history.slip_speed[0] = friction.slip_speed[0];
    response.history.mu            = friction.slipping ? friction.mu : 0.;
    response.history.damping       = dashpot.v;
    response.history.step          = law.weights.dt;
    response.energy                = spring_energy(law.normal, point.gap_end) + friction.energy;
    response.friction              = friction.dissipated;
    response.damping               = -damped.v * gap_change;
    response.algorithmic           = delay * work;
    response.creep                 = friction.creep;
    return response;
  }

  /// Tractions, forces and tangent of a single contact point; see BatchedStep for the points of a mesh on a rigid cylinder.
  template <int n>
  StepResponse<n> step_response(const StepKinematics<n> &point, const ContactHistory &history, const StepContactLaw &law)
  {
    return law.balance == ForceBalance::end ? end_response(point, history, law) : mean_response(point, history, law);
  }
} // namespace sprag
