#include "laws/contact_step.h"
#include "laws/friction.h"

#include "laws/contact.h"

#include <algorithm>
#include <cmath>

namespace sprag
{
  using dealii::Tensor;

  namespace
  {
    double force(const NormalLaw &law, const double gap)
    {
      if (gap >= 0.)
        return 0.;
      return law.exponent == 1. ? -law.stiffness * gap : law.stiffness * std::pow(-gap, law.exponent);
    }

    double derivative(const NormalLaw &law, const double gap)
    {
      if (gap >= 0.)
        return 0.;
      return law.exponent == 1. ? -law.stiffness : -law.stiffness * law.exponent * std::pow(-gap, law.exponent - 1.);
    }

    double energy(const NormalLaw &law, const double gap)
    {
      return gap < 0. ? -gap * force(law, gap) / (law.exponent + 1.) : 0.;
    }

    /// Speed of slip along a direction at the end of a step from the means of this step and the last:
    ///   w = scale * mean - offset . direction
    template <int slips>
    struct Extrapolation
    {
      Extrapolation(const FrictionHistory<slips> &history, const Tensor<1, slips> &direction, const double dt)
      {
        if (history.step == 0. || history.slip_speed * direction < 0.)
          return;
        const double share = dt / (dt + history.step);
        scale              = 1. + share;
        offset             = share * history.slip_speed;
      }

      double scale = 1.;
      Tensor<1, slips> offset;
    };

    template <int slips>
    EndFriction<slips> resolved(const FrictionHistory<slips> &history, const double stiffness,
                                const Tensor<1, slips> &slip_change, const double pressure, const FrictionLaw &law,
                                const double dt)
    {
      const auto trial = history.traction + stiffness * slip_change;
      const Extrapolation<slips> speed(history, Directed<slips>(trial).direction, dt);
      const double duration = dt / speed.scale;
      const auto returned   = friction_traction(trial, pressure, law, stiffness, duration, -duration * speed.offset);
      const auto slipped    = slip_change - (returned.traction - history.traction) / stiffness;
      EndFriction<slips> result;
      result.traction   = returned.traction;
      result.d_slip     = stiffness * returned.d_trial;
      result.d_pressure = returned.d_pressure;
      result.mu         = returned.mu;
      result.slipping   = returned.slipping;
      if (result.slipping)
        result.slip_speed = slipped / dt;
      result.energy     = 0.5 * result.traction.norm_square() / stiffness;
      result.dissipated = 0.5 * (history.traction + result.traction) * slipped;
      return result;
    }

    template <int slips>
    EndFriction<slips> regularised(const FrictionHistory<slips> &history, const Tensor<1, slips> &slip_change,
                                   const double pressure, const FrictionLaw &law, const double dt)
    {
      EndFriction<slips> result;
      result.slip_speed = slip_change / dt;
      const Directed<slips> mean(result.slip_speed);
      const Extrapolation<slips> along(history, mean.direction, dt);
      const double w    = along.scale * mean.size - along.offset * mean.direction;
      const auto share  = sliding_friction(law, w);
      result.d_pressure = share.coefficient * mean.direction;
      result.traction   = pressure * result.d_pressure;
      result.d_slip =
          pressure / dt * mean.derivative(share.coefficient, share.derivative * along.scale, -share.derivative * along.offset);
      result.mu         = friction_coefficient(law, std::abs(w)).coefficient;
      result.slipping   = true;
      result.dissipated = 0.5 * (history.traction + result.traction) * slip_change;
      result.creep      = mean.size < law.regularisation_speed ? slip_change.norm() : 0.;
      return result;
    }
  } // namespace

  MeanNormalForce mean_normal_force(const NormalLaw &law, const double gap_begin, const double gap_end)
  {
    MeanNormalForce result{ force(law, gap_begin), force(law, gap_end), derivative(law, gap_end), 0., 0., energy(law, gap_end) };
    const double change = gap_end - gap_begin;
    // Where the gap hardly changes Simpson's rule is exact to round-off and the quotient is not.
    if (std::abs(change) < 1e-3 * std::max(-gap_begin, -gap_end) || change == 0.)
    {
      const double middle = 0.5 * (gap_begin + gap_end);
      result.mean         = (result.begin + 4. * force(law, middle) + result.end) / 6.;
      result.d_mean       = (2. * derivative(law, middle) + result.d_end) / 6.;
    }
    else
    {
      result.mean   = (energy(law, gap_begin) - result.energy) / change;
      result.d_mean = (result.end - result.mean) / change;
    }
    return result;
  }

  SlidingFriction sliding_friction(const FrictionLaw &law, const double speed)
  {
    const auto mu    = friction_coefficient(law, std::abs(speed));
    const double v_r = law.regularisation_speed;
    if (v_r == 0.)
      return { std::copysign(mu.coefficient, speed), mu.derivative };
    const double root  = std::hypot(speed, v_r);
    const double share = speed / root;
    return { mu.coefficient * share, mu.derivative * std::abs(share) + mu.coefficient * v_r * v_r / (root * root * root) };
  }

  EndDamping end_damping(const double damping, const double normal, const double gap, const double gap_rate)
  {
    if (gap >= 0. || damping == 0.)
      return {};
    const double dashpot = -damping * gap_rate;
    return dashpot >= -normal ? EndDamping{ dashpot, 0., -damping } : EndDamping{ -normal, -1., 0. };
  }

  template <int slips>
  EndFriction<slips> end_friction(const FrictionHistory<slips> &history, const double stiffness,
                                  const Tensor<1, slips> &slip_change, const double pressure, const FrictionLaw &law,
                                  const double dt)
  {
    if (pressure > 0.)
      return law.regularisation_speed > 0. ? regularised(history, slip_change, pressure, law, dt)
                                           : resolved(history, stiffness, slip_change, pressure, law, dt);
    EndFriction<slips> open;
    const auto released = law.regularisation_speed > 0. ? Tensor<1, slips>() : history.traction / stiffness;
    open.dissipated     = 0.5 * history.traction * (slip_change + released);
    return open;
  }

  template EndFriction<1> end_friction(const FrictionHistory<1> &, double, const Tensor<1, 1> &, double, const FrictionLaw &,
                                       double);
  template EndFriction<2> end_friction(const FrictionHistory<2> &, double, const Tensor<1, 2> &, double, const FrictionLaw &,
                                       double);
} // namespace sprag
