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

  /// Derivatives of the slips of a point by n coordinates.
  template <int n, int slips>
  using SlipRows = std::array<dealii::Tensor<1, n>, slips>;

  /// Geometry of a contact point over a step, in n coordinates q: one gap and, in a plane, one slip, on a surface two. Rows "of
  /// the step" stand where generalised-alpha balances forces, at (1 - alpha_f) q_1 + alpha_f q_0, that is at the middle and the
  /// delay later; in [q], the change of q over the step,
  ///   row . [q] = [gap] + delay * gap_bend
  /// up to third order, and so for slip.
  template <int n, int slips = 1>
  struct StepKinematics
  {
    double gap_begin = 0.;
    double gap_end   = 0.;
    dealii::Tensor<1, n> gap_row_end;                       ///< d(gap_end)/dq_1
    dealii::Tensor<1, n> gap_row;                           ///< of the step
    dealii::Tensor<2, n> gap_curvature;                     ///< d(gap_row)/dq_1
    dealii::Tensor<1, slips> slip_change;                   ///< [mm]
    SlipRows<n, slips> slip_change_row;                     ///< d(slip_change)/dq_1
    SlipRows<n, slips> slip_row;                            ///< of the step
    std::array<dealii::Tensor<2, n>, slips> slip_curvature; ///< d(slip_row)/dq_1
    double gap_bend = 0.;                                   ///< [q] . d(gap_row)/dq [q] at the place of the rows [mm]
    dealii::Tensor<1, slips> slip_bend;                     ///< [q] . d(slip_row)/dq [q] [mm]
    double gap_rate_end = 0.;                               ///< counts with contact damping only [mm/s]
    dealii::Tensor<1, n> gap_rate_row;                      ///< d(gap_rate_end)/dq_1
    dealii::Tensor<1, slips> slip_shift;                    ///< see return_to_cone(); counts for a balance at the end [mm]
  };

  /// A step that ends at a point's kinematics and is balanced there, from where the slip coordinate was `slip_begin` [mm].
  template <int n>
  StepKinematics<n> step_to(const ContactKinematics<n> &end, const double slip_begin)
  {
    StepKinematics<n> result;
    result.gap_begin = result.gap_end = end.gap;
    result.gap_row_end = result.gap_row = end.gap_row;
    result.gap_curvature                = end.gap_curvature;
    result.slip_change[0]               = end.slip - slip_begin;
    result.slip_change_row = result.slip_row = { { end.slip_row } };
    result.slip_curvature                    = { { end.slip_curvature } };
    return result;
  }

  /// Sets rows, curvatures and bends of a step whose forces are balanced where the point has the kinematics `balance`, at a
  /// `share` of the `change` of the coordinates.
  template <int n>
  void set_balance(const ContactKinematics<n> &balance, const double share, const dealii::Tensor<1, n> &change,
                   StepKinematics<n> &step)
  {
    step.gap_row           = balance.gap_row;
    step.gap_curvature     = share * balance.gap_curvature;
    step.gap_bend          = change * (balance.gap_curvature * change);
    step.slip_row[0]       = balance.slip_row;
    step.slip_curvature[0] = share * balance.slip_curvature;
    step.slip_bend[0]      = change * (balance.slip_curvature * change);
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
  template <int n, int slips = 1>
  struct StepResponse : PointTraction
  {
    dealii::Tensor<1, slips> mean_traction; ///< of the step
    dealii::Tensor<1, n> force;             ///< of the step, generalised
    dealii::Tensor<2, n> tangent;           ///< d(force)/dq_1, unsymmetric
    dealii::Tensor<2, slips> d_shift;       ///< derivative of the traction by the slip's shift [N/mm^3]
    double energy      = 0.;                ///< of the springs at the end of the step
    double friction    = 0.;                ///< works dissipated in the step
    double damping     = 0.;
    double algorithmic = 0.;
    double creep       = 0.; ///< slip below the regularisation speed [mm]
  };

  template <int slips>
  SlipHistory<double, slips> slip_history(const ContactHistory &history)
  {
    SlipHistory<double, slips> result;
    result.step = history.step;
    result.mu   = history.mu;
    for (unsigned int s = 0; s < slips; ++s)
    {
      result.traction[s]   = history.traction[s];
      result.slip_speed[s] = history.slip_speed[s];
    }
    return result;
  }

  /// Numbers with derivatives by the gap at the end of a step, by its slips, and by what stands beside these: the shifts of the
  /// slips where forces are balanced at the end, else the rate of the gap.
  template <int slips>
  using StepNumber = Dual<double, 1 + 2 * slips>;

  template <int slips>
  Several<StepNumber<slips>, slips> variables(const dealii::Tensor<1, slips> &at, const int first)
  {
    Several<StepNumber<slips>, slips> result;
    for (int i = 0; i < slips; ++i)
      result[i] = variable<StepNumber<slips>>(at[i], first + i);
    return result;
  }

  /// Sets tractions at the end of a step, its force and the derivative of that.
  template <int n, int slips>
  void set_response(const StepKinematics<n, slips> &point, const StepNumber<slips> &end_pressure,
                    const PointFriction<StepNumber<slips>, slips> &end, const StepNumber<slips> &pressure,
                    const Several<StepNumber<slips>, slips> &traction, StepResponse<n, slips> &response)
  {
    const auto to_row = [&](const StepNumber<slips> &a)
    {
      auto row = a.d[0] * point.gap_row_end + a.d[1 + slips] * point.gap_rate_row;
      for (unsigned int r = 0; r < slips; ++r)
        row += a.d[1 + r] * point.slip_change_row[r];
      return row;
    };
    response.pressure = end_pressure.v;
    response.mu       = end.mu;
    response.slipping = end.slipping;
    response.force    = pressure.v * point.gap_row;
    response.tangent  = outer_product(point.gap_row, to_row(pressure)) + pressure.v * point.gap_curvature;
    for (unsigned int s = 0; s < slips; ++s)
    {
      response.traction[s]      = end.traction[s].v;
      response.mean_traction[s] = traction[s].v;
      response.force -= traction[s].v * point.slip_row[s];
      response.tangent -= outer_product(point.slip_row[s], to_row(traction[s])) + traction[s].v * point.slip_curvature[s];
    }
    response.history.traction = response.traction;
  }

  /// A balance at the end of a step: tractions and forces there. The history holds the multipliers of the current augmentation. A
  /// point that was open has no traction to start from: its slip history begins with the step in which it touches.
  template <int n, int slips>
  StepResponse<n, slips> end_response(const StepKinematics<n, slips> &point, const ContactHistory &history,
                                      const StepContactLaw &law)
  {
    using N = StepNumber<slips>;
    StepResponse<n, slips> response;
    const N pressure = history.normal_multiplier - law.normal.stiffness * variable<N>(point.gap_end, 0);
    if (!(pressure.v > 0.))
      return response;
    PointFriction<N, slips> friction;
    const auto slip   = variables(point.slip_change, 1);
    friction.traction = stick_traction(law.slip, slip_history<slips>(history).traction, slip);
    if (law.mode == FrictionMode::cone)
      friction =
          return_to_cone(law.slip, friction.traction, pressure, law.weights.dt, variables(point.slip_shift, 1 + slips), slip);
    set_response(point, pressure, friction, pressure, friction.traction, response);
    for (unsigned int s = 0; s < slips; ++s)
      for (unsigned int r = 0; r < slips; ++r)
        response.d_shift[s][r] = friction.traction[s].d[1 + slips + r];
    return response;
  }

  /// Forces of a step consistent with the time integration: the spring's pressure is the mean over the change of the gap
  /// (discrete gradient), so that opening and closing make no energy; friction, returned to the cone at the end of the step, acts
  /// with the mean of both ends; both with the delay of generalised-alpha, whose work is the scheme's dissipation.
  template <int n, int slips>
  StepResponse<n, slips> mean_response(const StepKinematics<n, slips> &point, const ContactHistory &history,
                                       const StepContactLaw &law)
  {
    using N = StepNumber<slips>;
    StepResponse<n, slips> response;
    const double delay = law.weights.delay(), alpha = law.weights.alpha_f;
    const N gap         = variable<N>(point.gap_end, 0);
    const double begin  = spring_force(law.normal, point.gap_begin);
    const N end         = spring_force(law.normal, gap);
    const N mean        = mean_spring_force(law.normal, point.gap_begin, gap);
    const N dashpot     = dashpot_force(law.damping, end, gap, variable<N>(point.gap_rate_end, 1 + slips));
    const N damped      = (1. - alpha) * dashpot + alpha * history.damping;
    const N pressure    = mean + delay * (end - begin) + damped;
    const auto slip     = variables(point.slip_change, 1);
    const auto before   = slip_history<slips>(history);
    const auto friction = end_friction(law.slip, before, slip, N(end + dashpot), law.weights.dt);
    if (mean.v == 0. && end.v == 0. && history.damping == 0. && history.traction == Slip())
      return response;

    const double gap_change = point.gap_end - point.gap_begin;
    double work             = -(end.v - begin) * gap_change - pressure.v * point.gap_bend;
    Several<N, slips> traction;
    for (unsigned int s = 0; s < slips; ++s)
    {
      traction[s] = (0.5 + delay) * friction.traction[s] + (0.5 - delay) * before.traction[s];
      work += (friction.traction[s].v - before.traction[s]) * point.slip_change[s] + traction[s].v * point.slip_bend[s];
      response.history.slip_speed[s] = friction.slip_speed[s];
    }
    set_response(point, N(end + dashpot), friction, pressure, traction, response);
    response.history.mu      = friction.slipping ? friction.mu : 0.;
    response.history.damping = dashpot.v;
    response.history.step    = law.weights.dt;
    response.energy          = spring_energy(law.normal, point.gap_end) + friction.energy;
    response.friction        = friction.dissipated;
    response.damping         = -damped.v * gap_change;
    response.algorithmic     = delay * work;
    response.creep           = friction.creep;
    return response;
  }

  /// The one place where contact tractions, forces and tangents come from.
  template <int n, int slips>
  StepResponse<n, slips> step_response(const StepKinematics<n, slips> &point, const ContactHistory &history,
                                       const StepContactLaw &law)
  {
    return law.balance == ForceBalance::end ? end_response(point, history, law) : mean_response(point, history, law);
  }
} // namespace sprag
