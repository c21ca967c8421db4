#pragma once

#include "laws/contact.h"
#include "laws/contact_step.h"

#include <deal.II/base/tensor.h>

namespace sprag
{
  /// Geometry of one contact point in n local generalised coordinates q at a given drive position.
  template <int n>
  struct ContactKinematics
  {
    double gap;                          ///< g [mm], positive when open
    dealii::Tensor<1, n> gap_row;        ///< dg/dq
    dealii::Tensor<2, n> gap_curvature;  ///< d2g/dq2
    double slip;                         ///< slip coordinate [mm]: its change is what the obstacle slides along the body
    dealii::Tensor<1, n> slip_row;       ///< d(slip)/dq
    dealii::Tensor<2, n> slip_curvature; ///< d2(slip)/dq2
    double slip_shift = 0.; ///< what the step's slip at the speed of its end is longer than its own, see friction_traction() [mm]
  };

  /// What a contact point remembers. In an accepted state: the values at the end of its step.
  struct ContactMemory
  {
    double normal_multiplier = 0.; ///< lambda [MPa]; stays 0 in the penalty method
    double traction          = 0.; ///< friction from which the stick predictor starts [MPa]; 0 while open
    double slip              = 0.; ///< slip coordinate at the end of the last accepted step [mm]

    // Steps in time only.
    double damping    = 0.; ///< force of the dashpot at the end of the last step, per area at points of a face
    double slip_speed = 0.; ///< mean of the last step, signed; 0 in stick and where there was no contact [mm/s]
    double step       = 0.; ///< duration of the last step if it ended in contact, else 0 [s]

    unsigned int point = 0; ///< of a face, where only points in contact are remembered

    FrictionHistory history() const
    {
      return { traction, slip_speed, step };
    }
  };

  /// Constants of a contact in one step.
  struct ContactLaw
  {
    double normal_penalty;     ///< [N/mm^3], > 0
    double tangential_penalty; ///< [N/mm^3], > 0
    FrictionLaw friction;
    double dt; ///< duration of the step, or as long as its slip would take at the speed of its end [s], > 0
  };

  enum class FrictionMode
  {
    cone, ///< stick or slip as the law decides
    stick ///< no slip: the predictor at a reversal and the stiffness in stick
  };

  /// Tractions of one point and, per unit area, the generalised force on the body and its derivative.
  template <int n>
  struct ContactResponse
  {
    double pressure = 0.; ///< [MPa]
    double traction = 0.; ///< [MPa], positive where the slip coordinate grows
    double mu       = 0.; ///< coefficient at the slip speed
    bool slipping   = false;
    double d_shift  = 0.;         ///< of the traction by the slip's shift [N/mm^3]
    dealii::Tensor<1, n> force;   ///< p dg/dq - t d(slip)/dq
    dealii::Tensor<2, n> tangent; ///< d(force)/dq at a given shift, unsymmetric
  };

  /// The one place where contact tractions and tangents come from. `memory` holds the slip coordinate at the start of the step
  /// and the multipliers of the current augmentation. A point that was open has no traction to start from: its slip history
  /// begins with the step in which it touches.
  template <int n>
  ContactResponse<n> contact_response(const ContactKinematics<n> &point, const ContactMemory &memory, const ContactLaw &law,
                                      const FrictionMode mode)
  {
    ContactResponse<n> response;
    const auto normal = normal_traction(point.gap, memory.normal_multiplier, law.normal_penalty);
    if (normal.pressure == 0.)
      return response;

    const double stick  = memory.traction + law.tangential_penalty * (point.slip - memory.slip);
    const auto friction = mode == FrictionMode::stick ? FrictionTraction{ stick, 1., 0., 0., false }
                                                      : friction_traction(stick, normal.pressure, law.friction,
                                                                          law.tangential_penalty, law.dt, point.slip_shift);

    response.pressure = normal.pressure;
    response.traction = friction.traction;
    response.mu       = friction.mu;
    response.slipping = friction.slipping;
    response.d_shift  = friction.d_shift;
    response.force    = normal.pressure * point.gap_row - friction.traction * point.slip_row;

    const auto d_pressure = normal.derivative * point.gap_row;
    const auto d_traction = friction.d_trial * law.tangential_penalty * point.slip_row + friction.d_pressure * d_pressure;
    response.tangent      = outer_product(point.gap_row, d_pressure) - outer_product(point.slip_row, d_traction) +
                       normal.pressure * point.gap_curvature - friction.traction * point.slip_curvature;
    return response;
  }
} // namespace sprag
