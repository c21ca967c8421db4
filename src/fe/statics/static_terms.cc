// SPDX-License-Identifier: GPL-3.0-only
#include "fe/statics/static_terms.h"

#include "laws/friction_of_step.h"
#include "scene/closed_form.h"

#include <algorithm>

namespace sprag
{
  StaticTerms static_terms(const FrictionLaw &friction, const std::optional<Geometry> &geometry, const DrivePoint &begin,
                           const DrivePoint &end, const FrictionMode mode)
  {
    constexpr double least_ratio = 1e-6;
    const double duration        = end.time - begin.time;
    StaticTerms result{ friction_of_step(friction, end.v), duration, mode };
    if (duration == 0.)
    {
      if (mode == FrictionMode::cone)
        result.friction = { CoulombFriction{ 0. } };
      result.duration = 1.;
      return result;
    }
    if (!geometry || end.x == begin.x)
      return result;
    const auto from    = kinematics(*geometry, begin.x);
    const auto to      = kinematics(*geometry, end.x);
    result.travel      = to.s - from.s;
    const double slid  = -result.travel - geometry->cylinder_radius * (to.theta - from.theta);
    result.speed_ratio = std::max(least_ratio, sliding_speed(*geometry, end.x, end.v) * duration / slid);
    result.duration /= result.speed_ratio;
    return result;
  }
} // namespace sprag
