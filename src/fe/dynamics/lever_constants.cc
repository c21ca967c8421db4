// SPDX-License-Identifier: GPL-3.0-only
#include "fe/dynamics/lever_constants.h"

#include "model/structure/lever_frame.h"
#include "scene/device.h"

namespace sprag
{
  LeverInertia lever_inertia(const Device &device)
  {
    const Lever &lever                                     = device.lever;
    std::map<dealii::types::material_id, double> densities = { { material_id::lever, lever.density },
                                                               { material_id::web, lever.density },
                                                               { material_id::plate, device.plate.density },
                                                               { material_id::layer, device.layer.density } };
    if (device.cylinder.type != CylinderType::rigid)
      densities[material_id::cylinder] = device.cylinder.density;
    return { densities, lever.tip_mass, lever.moment_of_inertia, lever.inertia, lever.hub_inertia, device.spring.behaviour };
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
