// SPDX-License-Identifier: GPL-3.0-only
#include "scene/lever_shape.h"

#include "scene/closed_form.h"
#include "scene/device.h"

namespace sprag
{
  std::array<double, 2> swept_contact(const Device &device)
  {
    return { { kinematics(device.geometry, device.drive.maximum()).s, kinematics(device.geometry, device.drive.minimum()).s } };
  }

  std::array<double, 2> friction_face(const Device &device)
  {
    if (device.plate.type == PlateType::on_sensors)
      return { { device.plate.begin, device.plate.end } };
    const double begin = device.lever.outline == LeverOutline::frame ? device.frame.root + device.frame.rib : 0.;
    return { { begin, device.lever.length } };
  }
} // namespace sprag
