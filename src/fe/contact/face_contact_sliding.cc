#include "fe/contact/face_contact.h"

#include "laws/friction_of_step.h"

namespace sprag
{
  void FaceContact::evaluate_sliding(const SlidingState &sliding)
  {
    // Slip in a second.
    clear(sliding.ports, sliding.drive.x, 1.);
    const auto at = configuration(displacement, sliding.drive.x);
    enter({ at, at });
    const auto range = clip(near());
    sliding_law      = friction_of_step(properties.friction, sliding.drive.v);
    speed_of_sliding = sliding.speed;
    std::visit(
        [&](auto &below)
        {
          for (unsigned int patch = range.begin; patch < range.end; ++patch)
            slide_patch(below, patch, sliding);
        },
        obstacle);
    sum_forces();
  }

  template <class ObstacleBelow>
  void FaceContact::slide_patch(ObstacleBelow &below, const unsigned int patch, const SlidingState &sliding)
  {
    below.enter(patch);
    for (unsigned int q = face.patches()[patch].begin; q < face.patches()[patch].end; ++q)
    {
      auto &state = add_state(patch, q);
      below.place(state);
      state.trial_pressure = -properties.penalties.normal * state.gap;
      state.slip_change    = sliding.speed;
      if (state.gap < 0.)
        below.slide(state, sliding, sliding_law, sums);
    }
    below.leave(sums);
  }

  std::vector<FrictionDelay> FaceContact::friction_delays() const
  {
    std::vector<FrictionDelay> result;
    if (sliding_law.regularisation_speed > 0.)
      return result;
    const auto at = configuration(displacement, last_x);
    enter({ at, at });
    std::visit(
        [&](auto &below)
        {
          unsigned int patch = dealii::numbers::invalid_unsigned_int;
          for (const auto &state : states)
            if (state.slipping)
            {
              if (state.patch != patch)
                below.enter(patch = state.patch);
              if (auto delay = delay_of(below, state))
                result.push_back(std::move(*delay));
            }
        },
        obstacle);
    return result;
  }

  template <class ObstacleBelow>
  std::optional<FrictionDelay> FaceContact::delay_of(ObstacleBelow &below, const FacePointState &state) const
  {
    const auto &penalty = properties.penalties;
    const auto share    = sliding_friction(sliding_law, state.slip_change);
    const double time   = share.derivative * state.pressure / penalty.tangential;
    if (!(time > 0.))
      return {};
    const auto rows = below.rows(state);
    FrictionDelay delay{ time, {}, {}, {} };
    for (auto *const row : { &delay.force, &delay.stiffness_row, &delay.rate_row })
      row->reinit(static_cast<unsigned int>(summed.ports.size()));
    const double by_speed = share.derivative * state.pressure;
    for (unsigned int i = 0; i < rows.ports.size(); ++i)
    {
      const unsigned int place = place_of_port[rows.ports[i]];
      delay.force[place]       = -rows.weight * rows.slip[i];
      delay.stiffness_row[place] =
          -share.coefficient * penalty.normal * rows.gap[i] + by_speed * speed_of_sliding * rows.stretch[i];
      delay.rate_row[place] = by_speed * rows.slip[i];
    }
    return delay;
  }
} // namespace sprag
