// SPDX-License-Identifier: GPL-3.0-only
#include "model/lever_frame.h"

#include "scene/mirrored_pair.h"
#include "scene/scene.h"

#include <cmath>

namespace sprag
{
  LeverFrame lever_frame(const Scene &scene, const PortLayout &ports, const double lever_mass)
  {
    LeverFrame frame{ {},
                      ports,
                      rest_inclination(scene),
                      moment_law(scene.spring),
                      ports.levers * scene.support.stiffness,
                      ports.levers * support_damping(scene.support, lever_mass),
                      dealii::Vector<double>(ports.size()),
                      scene.plate.sensor_stiffness,
                      swings(scene) };
    if (scene.layer.thickness > 0.)
      frame.largest_indentation = 0.5 * scene.layer.thickness;
    frame.lengths = 1.;
    for (unsigned int slope = 0; slope < ports.slopes; ++slope)
      frame.lengths[ports.slope(slope)] = 0.5 * scene.lever.width;
    for (unsigned int lever = 0; lever < ports.levers; ++lever)
    {
      frame.geometries.push_back(scene_of_lever(scene, lever).geometry);
      frame.lengths[ports.rotation(lever)] = scene.geometry.pivot_distance;
    }
    return frame;
  }

  double support_damping(const Support &support, const double lever_mass)
  {
    return 2. * support.damping * std::sqrt(support.stiffness * (support.mass + lever_mass));
  }
} // namespace sprag
