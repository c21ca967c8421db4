#pragma once

#include "laws/contact_step.h"
#include "model/contact_point.h"
#include "model/generalised_alpha.h"

namespace sprag
{
  /// Constants of a contact in one step of the time integration. Per area at points of a face, whole forces at a point contact.
  struct StepContactLaw
  {
    NormalLaw normal;
    double damping    = 0.; ///< force over rate of approach while closed [N s/mm]
    double tangential = 0.; ///< stiffness in stick, > 0
    FrictionLaw friction;
    StepWeights weights{};
  };

  /// Geometry of a contact point over a step, in n coordinates q. Rows "of the step" stand where generalised-alpha balances
  /// forces, at (1 - alpha_f) q_1 + alpha_f q_0, that is at the middle and the delay later; in [q], the change of q over the
  /// step,
  ///   row . [q] = [gap] + delay * gap_bend
  /// up to third order, and so for slip.
  template <int n>
  struct StepKinematics
  {
    double gap_begin;
    double gap_end;
    dealii::Tensor<1, n> gap_row_end;     ///< d(gap_end)/dq_1
    dealii::Tensor<1, n> gap_row;         ///< of the step
    dealii::Tensor<2, n> gap_curvature;   ///< d(gap_row)/dq_1
    double slip_change;                   ///< [mm]
    dealii::Tensor<1, n> slip_change_row; ///< d(slip_change)/dq_1
    dealii::Tensor<1, n> slip_row;        ///< of the step
    dealii::Tensor<2, n> slip_curvature;  ///< d(slip_row)/dq_1
    double gap_bend     = 0.;             ///< [q] . d(gap_row)/dq [q] at the place of the rows [mm]
    double slip_bend    = 0.;             ///< [q] . d(slip_row)/dq [q] [mm]
    double gap_rate_end = 0.;             ///< counts with contact damping only [mm/s]
    dealii::Tensor<1, n> gap_rate_row;    ///< d(gap_rate_end)/dq_1
  };

  /// What a contact point does in a step.
  template <int n>
  struct StepResponse
  {
    double pressure      = 0.; ///< at the end of the step, damping included
    double traction      = 0.; ///< at the end of the step, positive where the slip coordinate grows
    double mu            = 0.;
    bool slipping        = false;
    double mean_traction = 0.;    ///< of the step
    dealii::Tensor<1, n> force;   ///< of the step, generalised
    dealii::Tensor<2, n> tangent; ///< d(force)/dq_1, unsymmetric
    ContactMemory memory;         ///< at the end of the step; the slip coordinate is the caller's
    double energy      = 0.;      ///< of the springs at the end of the step
    double friction    = 0.;      ///< works dissipated in the step
    double damping     = 0.;
    double algorithmic = 0.;
    double creep       = 0.; ///< slip below the regularisation speed [mm]
  };

  /// Forces of a step consistent with the time integration: the spring's pressure is the mean over the change of the gap
  /// (discrete gradient), so that opening and closing make no energy; friction, returned to the cone at the end of the step, acts
  /// with the mean of both ends; both with the delay of generalised-alpha, whose work is the scheme's dissipation.
  template <int n>
  StepResponse<n> step_response(const StepKinematics<n> &point, const ContactMemory &memory, const StepContactLaw &law)
  {
    using dealii::outer_product;
    StepResponse<n> response;
    const double delay  = law.weights.delay();
    const auto normal   = mean_normal_force(law.normal, point.gap_begin, point.gap_end);
    const auto dashpot  = end_damping(law.damping, normal.end, point.gap_end, point.gap_rate_end);
    const auto friction = end_friction(memory.history(), law.tangential, point.slip_change, normal.end + dashpot.force,
                                       law.friction, law.weights.dt);
    if (normal.mean == 0. && normal.end == 0. && memory.damping == 0. && memory.traction == 0.)
      return response;

    const double gap_change = point.gap_end - point.gap_begin;
    const double begin      = normal.begin;
    const double damped     = (1. - law.weights.alpha_f) * dashpot.force + law.weights.alpha_f * memory.damping;
    const double pressure   = normal.mean + delay * (normal.end - begin) + damped;
    const double traction   = 0.5 * (memory.traction + friction.traction) + delay * (friction.traction - memory.traction);
    const double share      = 0.5 + delay;

    const auto d_end      = normal.d_end * point.gap_row_end;
    const auto d_dashpot  = dashpot.d_normal * d_end + dashpot.d_rate * point.gap_rate_row;
    const auto d_pressure = normal.d_mean * point.gap_row_end + delay * d_end + (1. - law.weights.alpha_f) * d_dashpot;
    const auto d_traction = share * (friction.d_slip * point.slip_change_row + friction.d_pressure * (d_end + d_dashpot));

    response.mean_traction = traction;
    response.force         = pressure * point.gap_row - traction * point.slip_row;
    response.tangent       = outer_product(point.gap_row, d_pressure) - outer_product(point.slip_row, d_traction) +
                       pressure * point.gap_curvature - traction * point.slip_curvature;

    response.pressure          = normal.end + dashpot.force;
    response.traction          = friction.traction;
    response.mu                = friction.mu;
    response.slipping          = friction.slipping;
    response.memory.traction   = friction.traction;
    response.memory.damping    = dashpot.force;
    response.memory.slip_speed = friction.slip_speed;
    response.memory.step       = law.weights.dt;
    response.energy            = normal.energy + friction.energy;
    response.friction          = friction.dissipated;
    response.damping           = -damped * gap_change;
    response.algorithmic       = -delay * (normal.end - begin) * gap_change +
                           delay * (friction.traction - memory.traction) * point.slip_change -
                           delay * (pressure * point.gap_bend - traction * point.slip_bend);
    response.creep = friction.creep;
    return response;
  }
} // namespace sprag
