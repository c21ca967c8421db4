#include "fe/contact/face_contact.h"

#include "laws/friction_of_step.h"

namespace sprag
{
  void FaceContact::evaluate_sliding(const SlidingState &state)
  {
    slide(state, false);
  }

  void FaceContact::slide(const SlidingState &sliding, const bool in_parts)
  {
    // Slip in a second.
    clear(sliding.ports, sliding.drive.x, 1.);
    sums.in_parts = in_parts;
    const auto at = configuration(displacement, sliding.drive.x);
    enter({ at, at });
    const auto patches = clip(near());
    const auto law     = friction_of_step(properties.friction, sliding.drive.v);
    std::visit(
        [&](auto &below)
        {
          for (const unsigned int patch : patches)
            slide_patch(below, patch, sliding, law);
        },
        obstacle);
    sum_forces();
  }

  template <class ObstacleBelow>
  void FaceContact::slide_patch(ObstacleBelow &below, const unsigned int patch, const SlidingState &sliding,
                                const FrictionLaw &law)
  {
    below.enter(patch);
    for (unsigned int q = face.patches()[patch].begin; q < face.patches()[patch].end; ++q)
    {
      auto &state = add_state(patch, q);
      below.place(state);
      state.trial_pressure = -properties.penalties.normal * state.gap;
      state.slip_change[0] = sliding.speed;
      if (state.gap < 0.)
        below.slide(state, sliding, law, sums);
    }
    below.leave(sums);
  }

  PortPerturbation FaceContact::linearise(const SlidingState &state)
  {
    slide(state, true);
    PortPerturbation result(summed.ports);
    for (const auto &of_patch : sums.parts)
      result.add(of_patch);
    summed.tangent = result.stiffness();
    return result;
  }
} // namespace sprag
