// SPDX-License-Identifier: GPL-3.0-only
#include "model/lever_frame.h"

#include "scene/device.h"
#include "scene/mirrored_pair.h"

#include <cmath>

namespace sprag
{
  LeverFrame lever_frame(const Device &device, const PortLayout &ports, const double lever_mass)
  {
    LeverFrame frame{ {},
                      ports,
                      rest_inclination(device),
                      moment_law(device.spring),
                      ports.levers * device.support.stiffness,
                      ports.levers * support_damping(device.support, lever_mass),
                      dealii::Vector<double>(ports.size()),
                      device.plate.sensor_stiffness,
                      swings(device) };
    if (device.layer.thickness > 0.)
      frame.largest_indentation = 0.5 * device.layer.thickness;
    frame.lengths = 1.;
    for (unsigned int slope = 0; slope < ports.slopes; ++slope)
      frame.lengths[ports.slope(slope)] = 0.5 * device.lever.width;
    for (unsigned int lever = 0; lever < ports.levers; ++lever)
    {
      frame.geometries.push_back(lever_device(device, lever).geometry);
      frame.lengths[ports.rotation(lever)] = device.geometry.pivot_distance;
    }
    return frame;
  }

  double support_damping(const Support &support, const double lever_mass)
  {
    return 2. * support.damping * std::sqrt(support.stiffness * (support.mass + lever_mass));
  }
} // namespace sprag
