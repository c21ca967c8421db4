#include "laws/contact_step.h"

#include "laws/contact.h"

#include <algorithm>
#include <cmath>

namespace sprag
{
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

    /// Speed of slip at the end of a step from the means of this step and the last: w = scale * mean - offset.
    struct Extrapolation
    {
      double scale  = 1.;
      double offset = 0.;
    };

    Extrapolation extrapolation(const FrictionHistory &history, const double direction, const double dt)
    {
      const double before = history.slip_speed * direction;
      if (history.step == 0. || before < 0.)
        return {};
      const double share = dt / (dt + history.step);
      return { 1. + share, share * before };
    }

    EndFriction resolved(const FrictionHistory &history, const double stiffness, const double slip_change, const double pressure,
                         const FrictionLaw &law, const double dt)
    {
      EndFriction result{};
      const double trial = history.traction + stiffness * slip_change;
      const double size  = std::abs(trial);
      const double limit = friction_coefficient(law, 0.).coefficient;
      result.mu          = limit;
      if (size <= limit * pressure)
      {
        result.traction = trial;
        result.d_slip   = stiffness;
      }
      else
      {
        const double direction = std::copysign(1., trial);
        const auto speed       = extrapolation(history, direction, dt);
        const double shifted   = size - speed.offset * stiffness * dt / speed.scale;
        result.slipping        = true;
        if (shifted <= limit * pressure)
        {
          result.traction   = direction * limit * pressure;
          result.d_pressure = direction * limit;
        }
        else
        {
          const auto returned = friction_traction(shifted, pressure, law, stiffness, dt / speed.scale);
          result.traction     = direction * returned.traction;
          result.d_slip       = stiffness * returned.d_trial;
          result.d_pressure   = direction * returned.d_pressure;
          result.mu           = returned.mu;
        }
      }
      const double slipped = slip_change - (result.traction - history.traction) / stiffness;
      result.slip_speed    = result.slipping ? slipped / dt : 0.;
      result.energy        = 0.5 * result.traction * result.traction / stiffness;
      result.dissipated    = 0.5 * (history.traction + result.traction) * slipped;
      return result;
    }

    EndFriction regularised(const FrictionHistory &history, const double slip_change, const double pressure,
                            const FrictionLaw &law, const double dt)
    {
      EndFriction result{};
      const double mean = slip_change / dt;
      const auto along  = extrapolation(history, std::copysign(1., mean), dt);
      const double w    = along.scale * mean - std::copysign(along.offset, mean);
      const auto share  = sliding_friction(law, w);
      result.traction   = share.coefficient * pressure;
      result.d_slip     = pressure * share.derivative * along.scale / dt;
      result.d_pressure = share.coefficient;
      result.mu         = friction_coefficient(law, std::abs(w)).coefficient;
      result.slipping   = true;
      result.slip_speed = mean;
      result.dissipated = 0.5 * (history.traction + result.traction) * slip_change;
      result.creep      = std::abs(mean) < law.regularisation_speed ? std::abs(slip_change) : 0.;
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

  EndFriction end_friction(const FrictionHistory &history, const double stiffness, const double slip_change,
                           const double pressure, const FrictionLaw &law, const double dt)
  {
    if (pressure > 0.)
      return law.regularisation_speed > 0. ? regularised(history, slip_change, pressure, law, dt)
                                           : resolved(history, stiffness, slip_change, pressure, law, dt);
    EndFriction open{};
    const double released = law.regularisation_speed > 0. ? 0. : history.traction / stiffness;
    open.dissipated       = 0.5 * history.traction * (slip_change + released);
    return open;
  }
} // namespace sprag
