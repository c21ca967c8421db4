#pragma once

#include "fe/solid/step_in_lanes_parts.h"

namespace sprag
{
  /// As end_friction() where stick is resolved: the slip speed at the end is extrapolated from the step's mean and the last
  /// one's. Returns the lanes that it did not find.
  SPRAG_PART LaneMask StepInLanes::rub_in_time(const Begin &begin, const End &end, FrictionInLanes &result) const
  {
    const double stiffness = of.law.tangential, dt = of.law.weights.dt;
    const Lanes &t_0 = begin.traction[0], &t_1 = begin.traction[1];
    const Lanes &g_0 = end.slip_change[0], &g_1 = end.slip_change[1];
    const Lanes before     = begin.slip_speed[0] * (t_0 + stiffness * g_0) + begin.slip_speed[1] * (t_1 + stiffness * g_1);
    const LaneMask goes_on = (begin.step > 0.) & (before >= 0.);
    const Lanes share      = goes_on ? dt / (dt + begin.step) : Lanes{};
    const Lanes duration   = dt / (1. + share);
    const Lanes shift      = -duration * share;
    const TrialInLanes trial{
      begin.traction, end.slip_change, { { shift * begin.slip_speed[0], shift * begin.slip_speed[1] } }, duration, end.pressure
    };
    const LaneMask unknown = return_to_cone(trial, law, stiffness, result);
    const Lanes traction   = result.traction[0] * result.traction[0] + result.traction[1] * result.traction[1];
    const Lanes s_0 = g_0 - (result.traction[0] - t_0) / stiffness, s_1 = g_1 - (result.traction[1] - t_1) / stiffness;
    const LaneMask &slips = result.slipping;
    result.slip_speed     = { { slips ? s_0 / dt : Lanes{}, slips ? s_1 / dt : Lanes{} } };
    result.energy         = 0.5 / stiffness * traction;
    result.dissipated     = 0.5 * ((t_0 + result.traction[0]) * s_0 + (t_1 + result.traction[1]) * s_1);
    return unknown;
  }

  /// Without inertia, as end_response().
  SPRAG_PART TrialInLanes StepInLanes::trial_at_end(const Begin &begin, const End &end) const
  {
    return { begin.traction,
             end.slip_change,
             { { end.shift + begin.elastic_shift, Lanes{} } },
             all_lanes(of.law.weights.dt),
             end.pressure };
  }

  SPRAG_PART void StepInLanes::slide_on(const End &end, FrictionInLanes &result) const
  {
    result.traction[0]    = of.slide->coefficient * end.pressure;
    result.mu             = all_lanes(of.slide->mu);
    result.slipping       = of.slide->rubs ? ~LaneMask{} : LaneMask{};
    result.slip_speed[0]  = all_lanes(of.slide->speed);
    result.by_pressure[0] = all_lanes(of.slide->coefficient);
    result.energy         = 0.5 * of.slide->compliance * result.traction[0] * result.traction[0];
  }

  /// Sets the friction of a block whose pressure and slip are known. Returns the lanes that are to be looked at one by one.
  SPRAG_PART LaneMask StepInLanes::rub(const Begin &begin, const End &end, FrictionInLanes &result) const
  {
    result = FrictionInLanes();
    if (of.slide)
    {
      slide_on(end, result);
      return LaneMask{};
    }
    const double stiffness = of.law.tangential;
    const bool is_static   = of.law.balance == ForceBalance::end;
    if (is_static && of.law.mode == FrictionMode::stick)
    {
      for (unsigned int s = 0; s < 2; ++s)
      {
        result.traction[s]        = begin.traction[s] + stiffness * end.slip_change[s];
        result.by_slip[2 * s + s] = all_lanes(stiffness);
      }
      return LaneMask{};
    }
    if (law.empty() || (!is_static && of.law.friction.regularisation_speed > 0.))
      return is_static ? end.takes_part : ~LaneMask{};
    return is_static ? return_to_cone(trial_at_end(begin, end), law, stiffness, result) : rub_in_time(begin, end, result);
  }

  /// The friction of a block that takes part, in all lanes.
  SPRAG_PART FrictionInLanes StepInLanes::friction_of(const Begin &begin, const End &end) const
  {
    FrictionInLanes result;
    const LaneMask unknown = rub(begin, end, result);
    if (any(unknown))
      for (unsigned int i = 0; i < n_lanes; ++i)
        if (unknown[i])
          rub_alone(begin, end, i, result);
    return result;
  }
} // namespace sprag
