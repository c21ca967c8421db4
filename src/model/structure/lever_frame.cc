// SPDX-License-Identifier: GPL-3.0-only
#include "model/structure/lever_frame.h"

#include "scene/device.h"
#include "scene/mirrored_pair.h"

#include <cmath>

namespace sprag
{
  LeverFrame lever_frame(const Device &device, const InterfaceLayout &layout, const double lever_mass)
  {
    LeverFrame frame{ {},
                      layout,
                      rest_inclination(device),
                      {},
                      layout.levers * device.support.stiffness,
                      layout.levers * support_damping(device.support, lever_mass),
                      dealii::Vector<double>(layout.size()),
                      device.plate.sensor_stiffness,
                      swings(device) };
    if (device.contact.damping_law == DampingLaw::loss_factor)
      frame.loss_factor = 2. * device.contact.damping;
    if (device.layer.thickness > 0.)
      frame.largest_indentation = 0.5 * device.layer.thickness;
    frame.lengths = 1.;
    for (unsigned int slope = 0; slope < layout.slopes; ++slope)
      frame.lengths[layout.slope(slope)] = 0.5 * device.lever.width;
    for (unsigned int lever = 0; lever < layout.levers; ++lever)
    {
      frame.geometries.push_back(lever_geometry(device, lever));
      frame.springs.push_back(moment_law(lever_spring(device, lever)));
      frame.lengths[layout.rotation(lever)] = device.geometry.pivot_distance;
    }
    return frame;
  }

  double support_damping(const Support &support, const double lever_mass)
  {
    return 2. * support.damping * std::sqrt(support.stiffness * (support.mass + lever_mass));
  }

  LeverDynamics make_lever_dynamics(const Device &device, const double relaxation, const double lever_mass)
  {
    LeverDynamics result;
    result.spring_stiffness  = device.spring.stiffness;
    result.mass_damping      = device.lever.mass_damping;
    result.stiffness_damping = device.lever.stiffness_damping;
    result.relaxation        = relaxation;
    result.modal_damping     = device.lever.modal_damping;
    result.sprung            = device.support.type == SupportType::sprung;
    result.support_mass      = device.support.mass + lever_mass;
    result.support_stiffness = device.support.stiffness;
    result.support_damping   = support_damping(device.support, lever_mass);
    return result;
  }
} // namespace sprag
