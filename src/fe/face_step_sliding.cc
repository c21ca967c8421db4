#include "fe/face_step.h"

#include "laws/friction_of_step.h"

namespace sprag
{
  using dealii::Vector;

  template <class Surface>
  void FaceStep<Surface>::evaluate_sliding(const SlidingState &sliding)
  {
    // Slip in a second.
    clear(sliding.ports, sliding.drive.x, 1.);
    const auto at = configuration(displacement, sliding.drive.x);
    surface.enter({ at, at });
    const auto range = clip(surface.near());
    sliding_law      = friction_of_step(properties.friction, sliding.drive.v);
    speed_of_sliding = sliding.speed;
    for (unsigned int patch = range.begin; patch < range.end; ++patch)
      slide_patch(patch, sliding);
    sum_forces();
  }

  template <class Surface>
  void FaceStep<Surface>::slide_patch(const unsigned int patch, const SlidingState &sliding)
  {
    surface.enter(patch);
    for (unsigned int q = face.patches()[patch].begin; q < face.patches()[patch].end; ++q)
    {
      auto &state = add_state(patch, q);
      surface.place(state);
      state.slip_change = sliding.speed;
      if (state.gap < 0.)
        surface.slide(state, sliding, sliding_law, sums);
    }
    surface.leave(sums);
  }

  template <class Surface>
  std::vector<FrictionDelay> FaceStep<Surface>::friction_delays() const
  {
    std::vector<FrictionDelay> result;
    const auto &penalty = properties.penalties;
    const auto at       = configuration(displacement, last_x);
    surface.enter({ at, at });
    unsigned int patch = dealii::numbers::invalid_unsigned_int;
    for (const auto &state : states)
    {
      if (!state.slipping || sliding_law.regularisation_speed > 0.)
        continue;
      const auto share  = sliding_friction(sliding_law, state.slip_change);
      const double time = share.derivative * state.pressure / penalty.tangential;
      if (!(time > 0.))
        continue;
      if (state.patch != patch)
        surface.enter(patch = state.patch);
      const auto rows = surface.rows(state);
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
      result.push_back(std::move(delay));
    }
    return result;
  }

  template class FaceStep<CircleSurface>;
  template class FaceStep<PairSurface>;
} // namespace sprag
