// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "laws/contact.h"
#include "laws/contact_step.h"
#include "model/contact_point.h"
#include "model/generalised_alpha.h"

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
    double damping    = 0.; ///< force over rate of approach while closed [N s/mm]
    double tangential = 0.; ///< stiffness in stick, > 0
    FrictionLaw friction;
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
    dealii::Tensor<1, slips> slip_shift;                    ///< see friction_traction(); counts for a balance at the end [mm]
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
  template <int slips>
  struct PointTraction
  {
    double pressure = 0.;              ///< damping included
    dealii::Tensor<1, slips> traction; ///< positive where the slip coordinate grows
    double mu     = 0.;
    bool slipping = false;
    PointMemory<slips> memory;
  };

  /// The response of a contact point to a step: its tractions at the end and its forces.
  template <int n, int slips = 1>
  struct StepResponse : PointTraction<slips>
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

  /// Sets tractions at the end of a step.
  template <class Friction, int slips>
  void set_tractions(const double pressure, const Friction &friction, PointTraction<slips> &result)
  {
    result.pressure        = pressure;
    result.traction        = friction.traction;
    result.mu              = friction.mu;
    result.slipping        = friction.slipping;
    result.memory.traction = friction.traction;
  }

  /// Sets the force of a step and its derivative: from a pressure and its derivative by the coordinates, and from a traction and
  /// its derivatives by the change of slip and by a pressure, that one with a derivative `pressure_row`.
  template <int n, int slips>
  void set_force(const StepKinematics<n, slips> &point, const double pressure, const dealii::Tensor<1, n> &d_pressure,
                 const dealii::Tensor<1, slips> &traction, const dealii::Tensor<2, slips> &by_slip,
                 const dealii::Tensor<1, slips> &by_pressure, const dealii::Tensor<1, n> &pressure_row,
                 StepResponse<n, slips> &response)
  {
    response.mean_traction = traction;
    response.force         = pressure * point.gap_row;
    response.tangent       = outer_product(point.gap_row, d_pressure) + pressure * point.gap_curvature;
    for (unsigned int s = 0; s < slips; ++s)
    {
      auto d_traction = by_pressure[s] * pressure_row;
      for (unsigned int r = 0; r < slips; ++r)
        d_traction += by_slip[s][r] * point.slip_change_row[r];
      response.force -= traction[s] * point.slip_row[s];
      response.tangent -= outer_product(point.slip_row[s], d_traction) + traction[s] * point.slip_curvature[s];
    }
  }

  /// A balance at the end of a step: tractions and forces there. The memory holds the multipliers of the current augmentation. A
  /// point that was open has no traction to start from: its slip history begins with the step in which it touches.
  template <int n, int slips>
  StepResponse<n, slips> end_response(const StepKinematics<n, slips> &point, const PointMemory<slips> &memory,
                                      const StepContactLaw &law)
  {
    StepResponse<n, slips> response;
    const auto normal = normal_traction(point.gap_end, memory.normal_multiplier, law.normal.stiffness);
    if (normal.pressure == 0.)
      return response;
    const auto stick = memory.traction + law.tangential * point.slip_change;
    const auto friction =
        law.mode == FrictionMode::stick
            ? FrictionTraction<slips>{ stick, dealii::unit_symmetric_tensor<slips>(), {}, 0., false, {} }
            : friction_traction(stick, normal.pressure, law.friction, law.tangential, law.weights.dt, point.slip_shift);
    const auto d_pressure = normal.derivative * point.gap_row_end;
    set_force(point, normal.pressure, d_pressure, friction.traction, law.tangential * friction.d_trial, friction.d_pressure,
              d_pressure, response);
    set_tractions(normal.pressure, friction, response);
    response.d_shift = friction.d_shift;
    return response;
  }

  /// Forces of a step consistent with the time integration: the spring's pressure is the mean over the change of the gap
  /// (discrete gradient), so that opening and closing make no energy; friction, returned to the cone at the end of the step, acts
  /// with the mean of both ends; both with the delay of generalised-alpha, whose work is the scheme's dissipation.
  template <int n, int slips>
  StepResponse<n, slips> mean_response(const StepKinematics<n, slips> &point, const PointMemory<slips> &memory,
                                       const StepContactLaw &law)
  {
    StepResponse<n, slips> response;
    const double delay  = law.weights.delay();
    const auto normal   = mean_normal_force(law.normal, point.gap_begin, point.gap_end);
    const auto dashpot  = end_damping(law.damping, normal.end, point.gap_end, point.gap_rate_end);
    const auto friction = end_friction(memory.history(), law.tangential, point.slip_change, normal.end + dashpot.force,
                                       law.friction, law.weights.dt);
    if (normal.mean == 0. && normal.end == 0. && memory.damping == 0. && memory.traction == dealii::Tensor<1, slips>())
      return response;

    const double gap_change    = point.gap_end - point.gap_begin;
    const double begin         = normal.begin;
    const double damped        = (1. - law.weights.alpha_f) * dashpot.force + law.weights.alpha_f * memory.damping;
    const double pressure      = normal.mean + delay * (normal.end - begin) + damped;
    const auto traction_change = friction.traction - memory.traction;
    const auto traction        = 0.5 * (memory.traction + friction.traction) + delay * traction_change;
    const double share         = 0.5 + delay;

    const auto d_end      = normal.d_end * point.gap_row_end;
    const auto d_dashpot  = dashpot.d_normal * d_end + dashpot.d_rate * point.gap_rate_row;
    const auto d_pressure = normal.d_mean * point.gap_row_end + delay * d_end + (1. - law.weights.alpha_f) * d_dashpot;

    set_force(point, pressure, d_pressure, traction, share * friction.d_slip, share * friction.d_pressure, d_end + d_dashpot,
              response);
    set_tractions(normal.end + dashpot.force, friction, response);
    response.memory.damping    = dashpot.force;
    response.memory.slip_speed = friction.slip_speed;
    response.memory.step       = law.weights.dt;
    response.energy            = normal.energy + friction.energy;
    response.friction          = friction.dissipated;
    response.damping           = -damped * gap_change;
    response.algorithmic       = delay * (traction_change * point.slip_change - (normal.end - begin) * gap_change -
                                    pressure * point.gap_bend + traction * point.slip_bend);
    response.creep             = friction.creep;
    return response;
  }

  /// The one place where contact tractions, forces and tangents come from.
  template <int n, int slips>
  StepResponse<n, slips> step_response(const StepKinematics<n, slips> &point, const PointMemory<slips> &memory,
                                       const StepContactLaw &law)
  {
    return law.balance == ForceBalance::end ? end_response(point, memory, law) : mean_response(point, memory, law);
  }
} // namespace sprag
