// SPDX-License-Identifier: GPL-3.0-only
#include "scene/lever_shape.h"

#include "scene/closed_form.h"
#include "scene/scene.h"

namespace sprag
{
  std::array<double, 2> swept_contact(const Scene &scene)
  {
    return { { kinematics(scene.geometry, scene.drive.maximum()).s, kinematics(scene.geometry, scene.drive.minimum()).s } };
  }

  std::array<double, 2> friction_face(const Scene &scene)
  {
    if (scene.plate.type == PlateType::on_sensors)
      return { { scene.plate.begin, scene.plate.end } };
    const double begin = scene.lever.outline == LeverOutline::frame ? scene.frame.root + scene.frame.rib : 0.;
    return { { begin, scene.lever.length } };
  }
} // namespace sprag
