// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "scene/closed_form.h"
#include "scene/scene.h"

namespace sprag
{
  /// Integral of Q dx over the drive [N mm]; over whole cycles it equals the friction work.
  inline double loop_area(const Scene &scene)
  {
    return work_between(scene, 0., scene.drive.duration()).drive;
  }

  /// Integral of F v_rel dt over the drive [N mm].
  inline double friction_work(const Scene &scene)
  {
    return work_between(scene, 0., scene.drive.duration()).friction;
  }
} // namespace sprag
