#include "fe/face_step_point.h"

#include <algorithm>
#include <cmath>

namespace sprag
{
  namespace
  {
    SlidingTangent tangent(const TangentPart part, const ContactFriction friction, const ContactPenalties &penalty,
                           const SlidingFriction &share, const double pressure)
    {
      SlidingTangent result;
      const bool all = part == TangentPart::all;
      if (all || part == TangentPart::pressure)
      {
        result.normal        = -penalty.normal;
        result.gap_curvature = pressure;
      }
      if ((all || part == TangentPart::friction) && friction == ContactFriction::stuck)
        result.tangential = -penalty.tangential;
      else if (all || part == TangentPart::friction)
      {
        result.coupled       = share.coefficient * penalty.normal;
        result.slip_gradient = -share.coefficient * pressure;
        result.by_speed      = -share.derivative * pressure;
      }
      if (part == TangentPart::friction_rate)
        result.tangential = -share.derivative * pressure;
      return result;
    }
  } // namespace

  SlidingTangent slide(const FaceStepProperties &properties, const FrictionLaw &law, const SlidingState &sliding,
                       const double weight, FacePointState &state, FaceStepSums &sums)
  {
    const auto &penalty     = properties.penalties;
    const bool slides       = sliding.friction == ContactFriction::sliding;
    const auto share        = slides ? sliding_friction(law, state.slip_change) : SlidingFriction{};
    state.pressure          = -penalty.normal * state.gap;
    state.traction          = share.coefficient * state.pressure;
    state.mu                = slides ? friction_coefficient(law, std::abs(state.slip_change)).coefficient : 0.;
    state.slipping          = slides;
    state.memory.traction   = state.traction;
    state.memory.slip_speed = sliding.speed;
    state.memory.point      = state.index;
    const double elastic    = law.regularisation_speed > 0. ? 0. : 0.5 * state.traction * state.traction / penalty.tangential;
    sums.stored += weight * (0.5 * penalty.normal * state.gap * state.gap + elastic);
    sums.compression = std::max(sums.compression, -state.gap);
    return tangent(sliding.part, sliding.friction, penalty, share, state.pressure);
  }
} // namespace sprag
