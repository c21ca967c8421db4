// SPDX-License-Identifier: GPL-3.0-only
#include "fe/dynamics/lever_constants.h"

#include "model/lever_frame.h"
#include "scene/scene.h"

namespace sprag
{
  LeverInertia inertia_of(const Scene &scene)
  {
    const Lever &lever                                     = scene.lever;
    std::map<dealii::types::material_id, double> densities = { { material_id::lever, lever.density },
                                                               { material_id::web, lever.density },
                                                               { material_id::plate, scene.plate.density },
                                                               { material_id::layer, scene.layer.density } };
    if (scene.cylinder.type != CylinderType::rigid)
      densities[material_id::cylinder] = scene.cylinder.density;
    return { densities, lever.tip_mass, lever.moment_of_inertia, lever.inertia, lever.hub_inertia, scene.spring.behaviour };
  }

  LeverDynamics constants_of(const Scene &scene, const double relaxation, const double lever_mass)
  {
    LeverDynamics result;
    result.spring_stiffness  = scene.spring.stiffness;
    result.mass_damping      = scene.lever.mass_damping;
    result.stiffness_damping = scene.lever.stiffness_damping;
    result.relaxation        = relaxation;
    result.modal_damping     = scene.lever.modal_damping;
    result.sprung            = scene.support.type == SupportType::sprung;
    result.support_mass      = scene.support.mass + lever_mass;
    result.support_stiffness = scene.support.stiffness;
    result.support_damping   = support_damping(scene.support, lever_mass);
    return result;
  }
} // namespace sprag
